// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>

#include <fmt/format.h>

#include <string>

namespace lmdbench::testing {

/// LMDs as text for messages of tests, one a line.
inline std::string text(const LmdSet& lmds) {
  std::string result;
  for (const Lmd& lmd : lmds)
    result += fmt::format("{:.17g} {} {} - {} {} at {:.17g} {:.17g} {:.17g}{}\n", lmd.distance,
                          to_string(lmd.feature_moving.kind), lmd.feature_moving.index,
                          to_string(lmd.feature_fixed.kind), lmd.feature_fixed.index, lmd.point_fixed.x(),
                          lmd.point_fixed.y(), lmd.point_fixed.z(), lmd.intersecting ? " intersecting" : "");
  return result;
}

/// A pose as C++ code.
inline std::string text(const Pose& pose) {
  return fmt::format(
      "{{Vec3({:.17g}, {:.17g}, {:.17g}), Eigen::Quaterniond({:.17g}, {:.17g}, {:.17g}, {:.17g})}}",
      pose.translation.x(), pose.translation.y(), pose.translation.z(), pose.rotation.w(), pose.rotation.x(),
      pose.rotation.y(), pose.rotation.z());
}

}  // namespace lmdbench::testing
