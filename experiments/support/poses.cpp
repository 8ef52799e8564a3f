// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/snch/minimum_distance.h>

#include <support/poses.h>

#include <stdexcept>
#include <string>

namespace lmdbench::experiments {
namespace {

/// A step shrinks what is left at least by the share that the motion has along the nearest direction; a line
/// that needs more steps than this slides along the surface.
constexpr int MAXIMUM_STEPS = 2000;

/// Haptic frames a second.
constexpr double FRAME_RATE_HZ = 1000.0;

Pose grazing_pose(const Body& moving, const Body& fixed, double gap, Random& random) {
  const TriangleMesh& moving_mesh = moving.surface().mesh;
  const TriangleMesh& fixed_mesh = fixed.surface().mesh;
  Pose X_WM;
  X_WM.rotation = random.rotation();
  const Vec3 towards_W = random.direction();
  const double apart =
      0.5 * (bounding_box_diagonal(moving_mesh) + bounding_box_diagonal(fixed_mesh)) + 2.0 * gap;
  const Vec3 centre_W = bounding_box_centre(fixed_mesh) - apart * towards_W;
  X_WM.translation = centre_W - X_WM.rotation * bounding_box_centre(moving_mesh);
  for (int i = 0; i < MAXIMUM_STEPS; ++i) {
    const double left = nearest_pair(moving.surface(), moving.prepared<Hierarchy>(), fixed.surface(),
                                     fixed.prepared<Hierarchy>(), X_WM)
                            .distance -
                        gap;
    if (left <= GAP_TOLERANCE * gap) return X_WM;
    X_WM.translation += left * towards_W;
  }
  throw std::runtime_error("no grazing pose between " + moving.name() + " and " + fixed.name() +
                           ": the approach line passes without coming near");
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

}  // namespace lmdbench::experiments
