// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/mesh/surface.h>

namespace lmdbench {

/// How far a direction may leave a polar cone before it counts as outside, as a sine: far above rounding of
/// the directions, far below any dihedral angle that a mesh means. Useful range 1e-12 .. 1e-8.
inline constexpr double FIRST_ORDER_TOLERANCE = 1e-10;

/// The same for the pieces of a plateau: wider, so that a plateau of which some piece passes the test holds
/// together although others are tilted by a little more. A plateau needs a piece that passes the narrow test.
inline constexpr double PLATEAU_PIECE_TOLERANCE = 10.0 * FIRST_ORDER_TOLERANCE;

/// Flat features of exact meshes at no larger angle (a sine) are parallel, whole: PLATEAU_PIECE_TOLERANCE on either mesh, and
/// as much for the rounding that is granted beside it. Beyond it the test passes for no piece that has a size.
inline constexpr double PARALLEL_TILT = 3.0 * PLATEAU_PIECE_TOLERANCE;

/// The first-order LMD condition (DEFINITION.md) for one side: no point of the triangles incident to
/// `feature` is nearer to the other point to first order, and the direction leaves on the outer side,
///   n . (x - p) <= 0 for every corner x of those triangles, n . pseudo_normal > 0.
/// Triangles are convex, so their corners decide. The outer side of boundary features is not asked for: the
/// polar of a half-plane's edge is a half-plane's worth of directions, on both sides of the sheet (ours); nor
/// that of non-manifold features, which have no side.
/// @param p_W  the point on `feature`, world frame
/// @param d_W  vector from p_W to the other point, not zero, any length, world frame
/// @param tolerance  sine by which d_W may leave the cone
bool in_outward_polar_cone(const Surface& surface, const RigidTransform& X_WS, const FeatureId& feature,
                           const Vec3& p_W, const Vec3& d_W, double tolerance = FIRST_ORDER_TOLERANCE);

/// Both sides of a pair: d in N_A(p) and -d in N_B(q). A pair at distance 0 has no direction and counts as an
/// LMD (decision E12).
bool is_local_minimum(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed, const Lmd& lmd,
                      double tolerance = FIRST_ORDER_TOLERANCE);

}  // namespace lmdbench
