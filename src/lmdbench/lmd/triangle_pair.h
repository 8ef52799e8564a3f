// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/mesh/surface.h>

#include <cmath>
#include <cstdint>

namespace lmdbench {

/// The nearest points of a triangle pair as an LMD with stable feature ids; `direction` is left unset,
/// because what a pair at distance 0 gets is the caller's decision (E12).
/// @param pair distance in world coordinates; a is the moving triangle
inline Lmd lmd_of_triangle_pair(const Surface& moving, const Surface& fixed, std::int32_t fixed_body,
                                std::int32_t t_moving, std::int32_t t_fixed,
                                const TrianglePairDistance& pair) {
  Lmd lmd;
  lmd.distance = std::sqrt(pair.squared_distance);
  lmd.point_moving = pair.point_a;
  lmd.point_fixed = pair.point_b;
  lmd.feature_moving = moving.feature_of(t_moving, pair.feature_a);
  lmd.feature_fixed = fixed.feature_of(t_fixed, pair.feature_b);
  lmd.triangle_moving = t_moving;
  lmd.triangle_fixed = t_fixed;
  lmd.fixed_body = fixed_body;
  lmd.intersecting = pair.intersecting;
  return lmd;
}

/// The same with the size of its set of minimisers, not judged yet; `direction` is
/// set where the points are apart.
inline LocalMinimum minimum_of_triangle_pair(const Surface& moving, const Surface& fixed,
                                             std::int32_t fixed_body, std::int32_t t_moving,
                                             std::int32_t t_fixed, const TrianglePairDistance& pair) {
  LocalMinimum minimum;
  minimum.lmd = lmd_of_triangle_pair(moving, fixed, fixed_body, t_moving, t_fixed, pair);
  if (minimum.lmd.distance > 0.0)
    minimum.lmd.direction = (pair.point_b - pair.point_a) / minimum.lmd.distance;
  minimum.dimension = pair.minimiser_dimension;
  minimum.measure = pair.minimiser_measure;
  return minimum;
}

/// Whether it is a local minimum or may be a piece of a plateau; `strict` says which.
inline bool meets_first_order(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed,
                              LocalMinimum& minimum) {
  minimum.strict = is_local_minimum(moving, X_WM, fixed, minimum.lmd);
  return minimum.strict || is_local_minimum(moving, X_WM, fixed, minimum.lmd, PLATEAU_PIECE_TOLERANCE);
}

}  // namespace lmdbench
