// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/surface.h>

#include <span>
#include <vector>

/// Outward polar cones: which directions a nearest-point pair may take at a feature (lmd/DEFINITION.md),
///   N(p) = { n : n . (x - p) <= 0 for every x on the triangles incident to p, n on the outer side }.
/// Only features whose cone is not empty can carry an LMD.
///
/// | feature                    | cone |
/// |----------------------------|------|
/// | face                       | its normal; empty where the face has no area |
/// | convex edge                | arc between the two face normals |
/// | flat edge                  | the normal |
/// | reflex edge                | empty |
/// | vertex                     | polar of its edge directions, on the side of the angle-weighted
/// pseudo-normal | | boundary edge              | half-plane: from the face's normal away from the face to
/// the opposite normal | | boundary vertex            | polar of its edge directions; no side is asked for,
/// as on a boundary edge (ours) | | non-manifold edge, vertex  | polar of all incident triangles; there is no
/// side to ask for (ours) | | edge without length, vertex without triangles | empty: its vertices carry the
/// LMD, or nothing does |
///
/// A triangle without area counts through its corners, as a segment or point. A triangle that lies there
/// twice makes its edges non-manifold, or its neighbours' edges boundaries, and is treated so.
namespace lmdbench {

/// How far a direction may leave a cone and still be reckoned in, as the sine of its angle with an incident
/// corner's direction. In doubt a feature keeps its cone: a needless feature costs a little time, a missing
/// one costs an LMD. Wider by far than the tolerance of the first-order test (FIRST_ORDER_TOLERANCE of lmd/),
/// so that every direction that passes that test lies in the cone built here; only where a pair is nearer
/// than about 1e-7 of its coordinates may rounding of the coordinates carry a direction out.
inline constexpr double POLAR_CONE_TOLERANCE = 1e-8;

/// A polar cone, given by rays whose conical hull contains it and every direction within the tolerance of it.
struct PolarCone {
  /// Unit vectors in the mesh's frame; empty for an empty cone. A face has one, a convex edge two close pairs
  /// (at its normals), a vertex its extreme rays, in no particular order. Where the cone reaches over more
  /// than a right angle there are rays between too, so that neighbouring ones never are opposite; such a cone
  /// is all but a half-space, and a circular cone round it is best taken as all directions.
  std::vector<Vec3> generators;

  bool empty() const { return generators.empty(); }
};

/// Whether the feature has an outer side: not on a boundary, its triangles are one consistently oriented fan
/// (an edge: two triangles), and its pseudo-normal is not zero.
bool has_outer_side(const Surface& surface, const FeatureId& feature);

PolarCone polar_cone(const Surface& surface, const FeatureId& feature);

/// Same as !polar_cone(surface, feature).empty(), cheaper.
bool has_polar_cone(const Surface& surface, const FeatureId& feature);

/// All features with a cone: vertices, then edges, then faces, by index.
std::vector<FeatureId> features_with_polar_cones(const Surface& surface);

/// The definition itself, by the incident triangles' corners.
/// @param p_M        point on the feature, mesh frame
/// @param d_M        direction, not zero, any length, mesh frame
/// @param tolerance  sine by which the direction may leave the cone
bool in_polar_cone(const Surface& surface, const FeatureId& feature, const Vec3& p_M, const Vec3& d_M,
                   double tolerance = POLAR_CONE_TOLERANCE);

/// Rays whose conical hull contains the polar { n : n . e <= 0 for every e } of a set of
/// directions, widened by a tolerance: their hull covers { n : |n| = 1, n . e <= tolerance for
/// every e }. Empty where that set is.
///
/// The widened set is cut out of the unit sphere by circles n . e = tolerance. It is bounded by arcs of
/// them, and, as any two circles of directions that are not parallel cross, it has a corner where two
/// circles cross or it is empty. So all crossings are tried against all directions: no polygon is
/// carried along, no order matters, and needles, straight edges, flat and coplanar sets need no cases.
/// Cubic in the worst case, quadratic in practice because a crossing outside is rejected by the
/// direction that rejected the one before.
///
/// Of more than 128 directions only some are taken, at first the outermost ones, then those that the rays so far
/// violate most, until the rays are good to twice the tolerance or there are enough: the set of fewer directions
/// is larger, so the rays still cover the cone, and whether it is empty is decided by all directions. A fat round
/// cone of thousands of directions so gets some hundred rays that reach a few thousandths of its width too far;
/// the work is linear in the number of directions.
/// @param directions  unit vectors; parallel ones allowed; none at all gives all directions
/// @param outer       if not zero: rays with n . outer < -tolerance are left out
/// @param first_only  stop at the first ray: only asks whether the set is empty
std::vector<Vec3> polar_rays(std::span<const Vec3> directions, const Vec3& outer, double tolerance,
                             bool first_only = false);

}  // namespace lmdbench
