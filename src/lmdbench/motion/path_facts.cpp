// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/motion/path_facts.h>
#include <lmdbench/motion/rotation_vector.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace lmdbench {
namespace {

double longest(const std::vector<Vec3>& vectors) {
  if (vectors.empty()) return std::numeric_limits<double>::quiet_NaN();
  double length = 0.0;
  for (const Vec3& v : vectors) length = std::max(length, v.norm());
  return length;
}

std::vector<Vec3> differences(const std::vector<Vec3>& vectors, double rate) {
  std::vector<Vec3> result;
  for (std::size_t i = 1; i < vectors.size(); ++i) result.push_back((vectors[i] - vectors[i - 1]) * rate);
  return result;
}

}  // namespace

PathFacts path_facts(const PathInterpolator& interpolator, double rate) {
  const Path frames = resample(interpolator, rate);
  LMDBENCH_ENSURES(!frames.empty(), "a path without poses");
  PathFacts facts;
  facts.pose_count = interpolator.path().size();
  facts.frame_count = frames.size();
  facts.sample_interval = interpolator.sample_interval();
  facts.gaps = interpolator.gaps().size();
  for (std::size_t i = 1; i < interpolator.path().size(); ++i)
    facts.longest_interval =
        std::max(facts.longest_interval, interpolator.path()[i].time - interpolator.path()[i - 1].time);
  facts.start_time = interpolator.start_time();
  facts.duration = interpolator.end_time() - interpolator.start_time();
  facts.lower_corner = facts.upper_corner = frames.front().pose.translation;
  std::vector<Vec3> velocities;
  std::vector<Vec3> angular_velocities;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const Pose& before = frames[k - 1].pose;
    const Pose& pose = frames[k].pose;
    const Vec3 step = pose.translation - before.translation;
    // In the world frame, so that differences of angular velocities are angular accelerations.
    const Vec3 turn = before.rotation * rotation_vector_of(before.rotation.conjugate() * pose.rotation);
    facts.length += step.norm();
    facts.turning += turn.norm();
    velocities.push_back(step * rate);
    angular_velocities.push_back(turn * rate);
    facts.lower_corner = facts.lower_corner.cwiseMin(pose.translation);
    facts.upper_corner = facts.upper_corner.cwiseMax(pose.translation);
  }
  facts.maximum_speed = longest(velocities);
  facts.maximum_angular_speed = longest(angular_velocities);
  facts.maximum_acceleration = longest(differences(velocities, rate));
  facts.maximum_angular_acceleration = longest(differences(angular_velocities, rate));
  return facts;
}

}  // namespace lmdbench
