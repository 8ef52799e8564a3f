// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/feature.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {

/// One local minimum distance pair, in world coordinates. Invariant: distance ==
/// |point_fixed - point_moving|, and `direction` is the unit vector from point_moving to
/// point_fixed (DEFINITION.md: d = q - p), but for the rounding of points that are far from the
/// origin (near_frame.h).
struct Lmd {
  double distance = std::numeric_limits<double>::quiet_NaN();                    ///< metres
  Vec3 point_moving = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< p_W, moving
  Vec3 point_fixed = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());   ///< q_W, fixed
  /// Unit vector p -> q. NaN where the triangles intersect and no earlier direction is known (E12).
  Vec3 direction = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  FeatureId feature_moving;
  FeatureId feature_fixed;
  std::int32_t triangle_moving = -1;  ///< Carries point_moving: where local tracking starts.
  std::int32_t triangle_fixed = -1;   ///< A triangle that carries point_fixed.
  std::int32_t fixed_body = 0;        ///< Which of the scene's fixed meshes.
  bool intersecting = false;          ///< The two triangles share a point (distance 0).
};

/// All LMDs of a pose. Methods return it sorted by `lmd_less`.
using LmdSet = std::vector<Lmd>;

/// Order of a reported LMD set: distance, then fixed body and features, so that it
/// depends on the scene alone.
bool lmd_less(const Lmd& a, const Lmd& b);

/// The LMD with its meshes exchanged; `fixed_body` stays.
Lmd turned_round(const Lmd& lmd);

/// Same fixed body and same feature pair.
bool same_feature_pair(const Lmd& a, const Lmd& b);

/// Smallest distance, or NaN for an empty set.
double minimum_distance(const LmdSet& lmds);

}  // namespace lmdbench
