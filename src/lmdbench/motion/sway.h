// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>

#include <cstdint>

namespace lmdbench {

/// A rule of motion for meshes that nobody recorded: to and fro about a place, along a line and about an axis, each of which is random.
struct Sway {
  double way_diagonals = 0.1;  ///< Farthest from the place, in diagonals of the mesh's bounding box.
  double turn_rad = 0.3;       ///< Largest turn; of large ones 2 atan(turn / 2).
  double period_s = 1.0;       ///< There and back.
  std::uint64_t seed = 1;
};

/// The motion of one of the meshes that share a rule. Nothing but correctly rounded operations: the same poses on every machine.
class SwayMotion {
 public:
  /// @param which    number of the mesh among those of the rule, which all go their own ways
  /// @param centre_M what the mesh turns about
  /// @param diagonal of the mesh's bounding box [m]
  SwayMotion(const Sway& rule, std::uint64_t which, const Vec3& centre_M, double diagonal);

  /// Pose in the frame of the place. Position and velocity are continuous: halves of parabolas in place of a sine.
  Pose at(double time) const;

 private:
  Vec3 centre_M_;
  Vec3 way_ = Vec3::Zero();   ///< At its farthest [m].
  Vec3 half_ = Vec3::Zero();  ///< Axis times half the largest turn.
  double period_s_;
  double phase_ = 0.0;
};

}  // namespace lmdbench
