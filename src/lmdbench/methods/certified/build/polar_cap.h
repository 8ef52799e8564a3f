// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/shape_complex.h>

#include <optional>

namespace lmdbench {

/// Circular cone around a feature's outward polar cone (decision/DEFINITION.md): every direction in which an LMD
/// may leave the feature lies inside. Half angle phi below 90 degrees, kept as cosine and sine; where no such
/// cone exists the axis is zero, which means all directions.
struct PolarCap {
  Vec3 axis = Vec3::Zero();  ///< unit in the mesh's frame, or zero for all directions
  double cosine = 0.0;
  double sine = 1.0;

  bool is_all_directions() const { return axis.isZero(0.0); }
};

/// Angle [rad] by which the caps are wider than the polar cones (PROOF.md, lemma 3). It covers what the definition allows a direction to leave its
/// cone by (decision/decide.h): rounding over the distance, which is at least RELATIVE_TOUCH of the coordinates
/// (128 * 2.2e-16 / 2e-8 = 1.5e-6), and rounding over the shortest wing that is not left out.
inline constexpr double POLAR_SLACK = 2e-6;

/// Wings shorter than this part of the mesh's largest coordinate are left out: the definition grants a direction more than
/// POLAR_SLACK against them (PROOF.md, lemma 3). Fewer constraints are a larger cap.
inline constexpr double LEAST_WING = 1e-6;

/// Cap of a feature (PROOF.md, lemmas 4 and 6), or nothing when the polar cone is empty even with the slack: such a feature (a reflex
/// edge, a saddle vertex, a pit) carries no LMD. A face without area carries none either.
///
/// The cone { n : n.e <= s |e| for all e } with e the edge directions (and the negated pseudo-normal
/// where the feature has an outer side) is a spherical polygon. Its corners lie where two of the
/// planes cross; those crossings that satisfy the other constraints up to the slack, amplified by
/// how obliquely the two planes cross, bound it. Boundary and non-manifold features have no outer
/// side and usually get all directions.
/// @param shape  where given, the cap is that of the region, chain or corner that the feature is the lead of
std::optional<PolarCap> polar_cap(const Surface& surface, const FeatureId& feature,
                                  const ShapeComplex* shape = nullptr);

}  // namespace lmdbench
