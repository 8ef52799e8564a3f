// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

#include <lmdbench/lmd/body_distance.h>

#include <study/scaling/slide.h>

namespace lmdbench::scaling {

std::vector<Pose> lead_in(const Body& moving, const Body& fixed, const Pose& end, double diagonal,
                          std::size_t frames, experiments::Random& random) {
  const TrianglePairDistance nearest = nearest_pair(moving, fixed, end).pair;
  const Vec3 normal_W = (nearest.point_b - nearest.point_a).normalized();
  const Vec3 pivot_W = nearest.point_a;
  const Vec3 tangent_W = normal_W.cross(random.direction()).normalized();
  const Vec3 axis_W = random.direction();
  std::vector<Pose> poses;
  for (std::size_t left = frames; left > 0; --left) {
    const auto back = -static_cast<double>(left);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(back * TURN_RAD_PER_FRAME, axis_W));
    Pose pose;
    pose.rotation = (turn * end.rotation).normalized();
    pose.translation = pivot_W + turn * (end.translation - pivot_W) +
                       back * SLIDE_DIAGONALS_PER_FRAME * diagonal * tangent_W;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace lmdbench::scaling
