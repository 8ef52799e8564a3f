// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/shape_complex.h>

#include <cstdint>
#include <optional>

namespace lmdbench {

/// Circular cone around a feature's outward polar cone (decision/DEFINITION.md): all directions in
/// which an LMD may leave the feature. Half angle phi below 90 degrees, as cosine and sine; where
/// there is no such cone the axis is zero, which means all directions.
struct PolarCap {
  Vec3 axis = Vec3::Zero();  ///< unit in the mesh's frame, or zero for all directions
  double cosine = 0.0;
  double sine = 1.0;

  bool is_all_directions() const { return axis.isZero(0.0); }
};

/// Angle [rad] by which caps are wider than polar cones (PROOF.md, lemma 3): rounding over the
/// distance, which is at least RELATIVE_TOUCH of the coordinates (128 * 2.2e-16 / 2e-8 = 1.5e-6),
/// and rounding over the shortest wing that counts.
inline constexpr double POLAR_SLACK = 2e-6;
/// That of regions and chains, which count as parallel at a small tilt (PROOF.md, lemma 2): wings
/// of parallel chains are granted it.
inline constexpr double PARALLEL_SLACK = POLAR_SLACK + LARGEST_PARALLEL_TILT;

/// Shorter wings, relative to the mesh's largest coordinate, are left out: against them the
/// definition grants more than POLAR_SLACK (PROOF.md, lemma 3). Fewer constraints give a larger
/// cap; that of lines as short is all directions.
inline constexpr double LEAST_WING = 1e-6;

/// Bits of a vertex's wings, of which only the first 32 have one.
using WingSet = std::uint32_t;

/// Cap of a feature (PROOF.md, lemmas 4 to 6); nothing where the polar cone is empty even with the
/// slack: a reflex edge, a saddle or a pit carries no LMD. Nor does a face without area. An edge
/// that is reflex by less than the slack does, along an edge parallel to it.
///
/// The cone { n : n . e <= s |e| for all e } is a spherical polygon; e are the edge directions, and
/// the negated pseudo-normal where there is an outer side. Crossings of two planes that satisfy the
/// other constraints, up to the slack amplified by how obliquely the two cross, bound it. Boundary
/// and non-manifold features have no outer side and usually get all directions.
/// @param shape  where given, the feature is the lead of one of its regions, chains or corners
/// @param bounding  of a vertex, where given: wings that bounded the cone of nearly the same
///   vertex, 0 for unknown; becomes those that bound this one. Where no other wing cuts off what
///   these leave, none is searched.
std::optional<PolarCap> polar_cap(const Surface& surface, const FeatureId& feature,
                                  const ShapeComplex* shape = nullptr, WingSet* bounding = nullptr);

}  // namespace lmdbench
