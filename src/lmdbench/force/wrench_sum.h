// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>

namespace lmdbench {

/// Adds up what pairs exert.
class WrenchSum {
 public:
  explicit WrenchSum(const Vec3& reference_W) : reference_W_(reference_W) {}

  /// Whether a pair exerts a force. Decision E12, ours: an LMD at distance 0 pushes, saturated,
  /// along the last valid direction if the method knows it, else not at all.
  static bool acts(const Lmd& lmd, const ForceProfile& profile) {
    return !(lmd.distance >= profile.cutoff) && !(lmd.distance <= 0.0 && !lmd.direction.allFinite());
  }
  /// A force of `length` [N] on the moving mesh along -direction, at the pair's point of it.
  void push(const Lmd& lmd, double length) {
    const Vec3 force_W = -length * lmd.direction;
    add(force_W, (lmd.point_moving - reference_W_).cross(force_W));
  }
  void add(const Vec3& force_W, const Vec3& torque) {
    force_ += force_W;
    torque_ += torque;
    lengths_ += force_W.stableNorm();
  }
  /// A force along `along` that grows by `stiffness` [N/m] with the way along `measured`.
  void stiffen(const Vec3& along, const Vec3& measured, double stiffness) {
    stiffness_W_ += stiffness * along * measured.transpose();
  }
  /// Forces that cancel to rounding are none: their sum has no direction.
  Wrench wrench() const;

 private:
  Vec3 reference_W_, force_ = Vec3::Zero(), torque_ = Vec3::Zero();
  Mat3 stiffness_W_ = Mat3::Zero();
  double lengths_ = 0.0;  ///< Sum of those of all forces [N].
};

}  // namespace lmdbench
