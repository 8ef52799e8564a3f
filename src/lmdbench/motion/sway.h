// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>

#include <cstdint>

namespace lmdbench {

/// How meshes without a recording move: to and fro about a place, on a random line and axis.
struct Sway {
  double way_diagonals = 0.1;  ///< Largest distance from the place, in diagonals of the mesh.
  double turn_rad = 0.3;       ///< Largest turn; of large ones 2 atan(turn / 2).
  double period_s = 1.0;       ///< There and back.
  std::uint64_t seed = 1;
};

/// Motion of one mesh of a rule. Correctly rounded operations alone: same poses on every machine.
class SwayMotion {
 public:
  /// @param which number of the mesh among those of the rule, each of which moves differently
  /// @param centre_M what the mesh turns about
  /// @param diagonal of the mesh's bounding box [m]
  SwayMotion(const Sway& rule, std::uint64_t which, const Vec3& centre_M, double diagonal);

  /// Pose in the place's frame. C1: halves of parabolas in place of a sine.
  Pose at(double time) const;

 private:
  Vec3 centre_M_;
  Vec3 way_ = Vec3::Zero();   ///< Displacement at its largest [m].
  Vec3 half_ = Vec3::Zero();  ///< Axis times half the largest turn.
  double period_s_;
  double phase_ = 0.0;
};

}  // namespace lmdbench
