// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/snch/first_approach.h>
#include <lmdbench/snch/minimum_distance.h>

#include <limits>

/// Distances of snch/ between two bodies, by the hierarchies that these have prepared: a call takes
/// the locks of `Body::prepared`.
namespace lmdbench {

inline NearestPair nearest_pair(const Body& moving, const Body& fixed, const Pose& X_WM,
                                double upper_bound = std::numeric_limits<double>::infinity()) {
  return nearest_pair(moving.surface(), moving.prepared<Hierarchy>(), fixed.surface(),
                      fixed.prepared<Hierarchy>(), X_WM, upper_bound);
}

inline bool within_distance(const Body& moving, const Body& fixed, const Pose& X_WM, double distance) {
  return within_distance(moving.surface(), moving.prepared<Hierarchy>(), fixed.surface(),
                         fixed.prepared<Hierarchy>(), X_WM, distance);
}

inline FirstApproach first_approach(const Body& moving, const Body& fixed, const Pose& X_WM,
                                    const Vec3& direction_W, double gap, double tolerance,
                                    const FirstApproach& begin = {}) {
  return first_approach(moving.surface(), moving.prepared<Hierarchy>(), fixed.surface(),
                        fixed.prepared<Hierarchy>(), X_WM, direction_W, gap, tolerance, begin);
}

}  // namespace lmdbench
