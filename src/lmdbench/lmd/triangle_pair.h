// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/mesh/surface.h>

#include <cmath>
#include <cstdint>

namespace lmdbench {

/// Nearest points of a triangle pair as an LMD with stable feature ids. `direction` stays unset: at
/// distance 0 it is the caller's decision (E12).
/// @param pair distance in world coordinates; a is the moving triangle
inline Lmd lmd_of_triangle_pair(const Surface& moving, const Surface& fixed, std::int32_t t_moving,
                                std::int32_t t_fixed, const TrianglePairDistance& pair) {
  Lmd lmd;
  lmd.distance = std::sqrt(pair.squared_distance);
  lmd.point_moving = pair.point_a;
  lmd.point_fixed = pair.point_b;
  lmd.feature_moving = moving.feature_of(t_moving, pair.feature_a);
  lmd.feature_fixed = fixed.feature_of(t_fixed, pair.feature_b);
  lmd.triangle_moving = t_moving;
  lmd.triangle_fixed = t_fixed;
  lmd.intersecting = pair.intersecting;
  return lmd;
}

}  // namespace lmdbench
