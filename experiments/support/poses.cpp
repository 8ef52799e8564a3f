// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/tum_file.h>

#include <support/poses.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace lmdbench::experiments {
namespace {

/// Haptic frames a second.
constexpr double FRAME_RATE_HZ = 1000.0;

Pose grazing_pose(const Body& moving, const Body& fixed, double gap, Random& random) {
  Pose X_WM;
  X_WM.rotation = random.rotation();
  const Vec3 from_W = -random.direction();
  X_WM.translation =
      bounding_box_centre(fixed.surface().mesh) - X_WM.rotation * bounding_box_centre(moving.surface().mesh);
  const double displacement = first_approach(moving, fixed, X_WM, from_W, gap, GAP_TOLERANCE).displacement;
  if (!std::isfinite(displacement))
    throw std::runtime_error("no grazing pose between " + moving.name() + " and " + fixed.name() +
                             ": the approach line passes without coming near");
  X_WM.translation += displacement * from_W;
  return X_WM;
}

}  // namespace

std::vector<Pose> grazing_poses(const Body& moving, const Body& fixed, double gap, std::size_t count,
                                std::uint64_t seed) {
  Random random(seed);
  std::vector<Pose> poses;
  poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) poses.push_back(grazing_pose(moving, fixed, gap, random));
  return poses;
}

std::vector<Pose> path_poses(const std::filesystem::path& file, std::size_t first, std::size_t count) {
  const Path frames = resample(PathInterpolator(read_tum(file)), FRAME_RATE_HZ);
  if (frames.size() < first + count)
    throw std::runtime_error(file.string() + " has only " + std::to_string(frames.size()) + " frames");
  std::vector<Pose> poses;
  for (std::size_t i = first; i < first + count; ++i) poses.push_back(frames[i].pose);
  return poses;
}

std::vector<Pose> trembling_poses(const Pose& begin, double step, double turn, std::size_t count,
                                  Random& random) {
  std::vector<Pose> poses{begin};
  while (poses.size() < count) {
    Pose next = poses.back();
    next.translation += step * random.direction();
    next.rotation = (Eigen::AngleAxisd(turn, random.direction()) * next.rotation).normalized();
    poses.push_back(next);
  }
  return poses;
}

}  // namespace lmdbench::experiments
