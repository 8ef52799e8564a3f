// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregate.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace lmdbench {

Wrench sum_forces(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W) {
  Wrench sum;
  Mat3 stiffness_W = Mat3::Zero();  // -dF/dx: sum of k_i n_i n_i^T
  for (const Lmd& lmd : lmds) {
    if (lmd.distance >= profile.cutoff) continue;
    // Decision E12, ours: distance 0 has no direction of its own. Where the method still knows the last valid
    // one, the LMD pushes along it, saturated; where it does not, pushing anywhere would be an invention.
    if (lmd.distance <= 0.0 && !lmd.direction.allFinite()) continue;
    const Vec3 force_W = -force_magnitude(profile, lmd.distance) * lmd.direction;
    sum.force += force_W;
    sum.torque += (lmd.point_moving - reference_W).cross(force_W);
    stiffness_W += force_stiffness(profile, lmd.distance) * lmd.direction * lmd.direction.transpose();
  }
  const double length = sum.force.stableNorm();
  if (length > 0.0) {
    const Vec3 away_W = sum.force / length;
    sum.stiffness = away_W.dot(stiffness_W * away_W);
  } else if (length == 0.0) {
    // Balanced forces leave no direction to translate along: the stiffest one is reported.
    sum.stiffness = Eigen::SelfAdjointEigenSolver<Mat3>(stiffness_W, Eigen::EigenvaluesOnly).eigenvalues()[2];
  } else {
    sum.stiffness = length;  // NaN in, NaN out: a broken LMD stays visible.
  }
  return sum;
}

}  // namespace lmdbench
