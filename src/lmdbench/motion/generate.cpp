// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/motion/generate.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/majorant.h>
#include <lmdbench/motion/wander.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lmdbench {
namespace {

/// Pose whose moving centre lies at `centre_distance` from the fixed centre.
Pose pose_at(const PathScene& scene, const Vec3& direction_W, const Eigen::Quaterniond& rotation,
             double centre_distance) {
  // A pose's translation is the one of the mesh frame's origin, which need not be the centre.
  return {scene.fixed_centre_W + centre_distance * direction_W - rotation * scene.moving_centre_M, rotation};
}

}  // namespace

double first_centre_distance(const PathScene& scene, const Vec3& direction_W,
                             const Eigen::Quaterniond& rotation, double gap) {
  LMDBENCH_EXPECTS(is_unit(direction_W) && gap > 0.0,
                   "a direction that was not normalised, or a gap of another unit");
  if (scene.centre_distance) return scene.centre_distance(direction_W, rotation, gap);
  double centre_distance = scene.moving_radius + scene.fixed_radius + gap;
  for (int step = 0; step < MAXIMUM_APPROACH_STEPS; ++step) {
    const double excess = scene.distance(pose_at(scene, direction_W, rotation, centre_distance)) - gap;
    if (excess <= GAP_TOLERANCE * gap) break;
    centre_distance -= excess;
    if (centre_distance <= 0.0) return 0.0;
  }
  return centre_distance;
}

double wanted_gap(const std::vector<GapPoint>& gaps, double time) {
  LMDBENCH_EXPECTS(!gaps.empty() && std::ranges::is_sorted(gaps, {}, &GapPoint::time),
                   "a specification that was not checked (path_spec.h)");
  const auto next = std::upper_bound(gaps.begin(), gaps.end(), time,
                                     [](double t, const GapPoint& point) { return t < point.time; });
  if (next == gaps.begin()) return gaps.front().gap;
  if (next == gaps.end()) return gaps.back().gap;
  const GapPoint& from = *(next - 1);
  const double u = (time - from.time) / (next->time - from.time);
  const double step = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
  return from.gap * std::pow(next->gap / from.gap, step);
}

Path generate_path(const PathSpec& spec, const PathScene& scene, const ProgressFunction& progress) {
  std::mt19937_64 generator(spec.seed);
  LMDBENCH_EXPECTS(spec.frame_rate > 0.0 && spec.stored_rate > 0.0,
                   "a specification that was not checked (path_spec.h)");
  const double time_step = 1.0 / spec.frame_rate;
  const auto frame_total =
      static_cast<std::size_t>(std::floor(spec.duration() * spec.frame_rate + LAST_FRAME_TOLERANCE)) + 1;
  const Eigen::Quaterniond start_rotation = uniform_rotation(generator);
  const Wander turning(spec.turn_rate, generator);
  const Wander sliding(spec.slide_rate, generator);
  const auto rotations = turning.rotations(start_rotation, time_step, frame_total);
  const auto direction_turns = sliding.rotations(Eigen::Quaterniond::Identity(), time_step, frame_total);

  std::vector<double> reaches(frame_total);
  for (std::size_t k = 0; k < frame_total; ++k) {
    const double gap = scene.diagonal * wanted_gap(spec.gaps, static_cast<double>(k) / spec.frame_rate);
    reaches[k] = first_centre_distance(scene, direction_turns[k] * spec.start_direction, rotations[k], gap);
    if (progress) progress(k + 1, frame_total);
  }
  reaches = bounded_majorant(reaches, time_step, spec.radial_limits(scene.diagonal));

  const auto stride = static_cast<std::size_t>(std::lround(spec.frame_rate / spec.stored_rate));
  Path path;
  for (std::size_t k = 0; k < frame_total; k += stride)
    path.push_back({static_cast<double>(k) / spec.frame_rate,
                    pose_at(scene, direction_turns[k] * spec.start_direction, rotations[k], reaches[k])});
  return path;
}

std::size_t GapMeasure::frames_within(double limit) const {
  return static_cast<std::size_t>(
      std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return gap <= limit; }));
}

GapMeasure measure_gaps(const Path& frames, const DistanceFunction& distance,
                        const ProgressFunction& progress) {
  GapMeasure measure;
  measure.gaps.reserve(frames.size());
  for (const TimedPose& frame : frames) {
    measure.gaps.push_back(distance(frame.pose));
    if (progress) progress(measure.gaps.size(), frames.size());
  }
  const auto nearest = std::min_element(measure.gaps.begin(), measure.gaps.end());
  LMDBENCH_EXPECTS(nearest != measure.gaps.end(), "a path without frames");
  measure.nearest_frame = static_cast<std::size_t>(nearest - measure.gaps.begin());
  return measure;
}

}  // namespace lmdbench
