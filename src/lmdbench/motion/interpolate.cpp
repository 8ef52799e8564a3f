// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/rotation_vector.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace lmdbench {
namespace {

/// Slopes at the poses from the secants between them: inside, of the parabola through a pose and
/// its two neighbours; at the ends, of the outermost such parabola.
std::vector<Vec3> parabola_slopes(const std::vector<double>& steps, const std::vector<Vec3>& secants) {
  const std::size_t count = secants.size() + 1;
  LMDBENCH_EXPECTS(steps.size() == secants.size() || secants.empty(), "parallel arrays of unlike lengths");
  if (secants.size() < 2)
    return std::vector<Vec3>(count, secants.empty() ? Vec3(Vec3::Zero()) : secants.front());
  std::vector<Vec3> slopes(count);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before = steps[i - 1];
    const double after = steps[i];
    slopes[i] = (after * secants[i - 1] + before * secants[i]) / (before + after);
  }
  // A parabola's secant is the mean of its end slopes.
  slopes.front() = 2.0 * secants.front() - slopes[1];
  slopes.back() = 2.0 * secants.back() - slopes[count - 2];
  return slopes;
}

Vec3 hermite(const Vec3& p0, const Vec3& step_v0, const Vec3& p1, const Vec3& step_v1, double u) {
  const Vec3 chord = p1 - p0;
  // An offset from p0: far from the origin a blend of p0 and p1 would round the motion away.
  return p0 + u * (step_v0 +
                   u * ((3.0 * chord - 2.0 * step_v0 - step_v1) + u * (step_v0 + step_v1 - 2.0 * chord)));
}

Eigen::Quaterniond bezier(const Eigen::Quaterniond& q0, const Vec3& step_w0, const Eigen::Quaterniond& q3,
                          const Vec3& step_w1, double u) {
  const Vec3 w_1 = step_w0 / 3.0;
  const Vec3 w_3 = step_w1 / 3.0;
  // The middle factor closes the curve: q0 exp(w_1) exp(w_2) exp(w_3) = q3.
  const Vec3 w_2 = rotation_vector_of((q0 * rotation_of(w_1)).conjugate() * q3 * rotation_of(-w_3));
  const double b_1 = u * (3.0 + u * (-3.0 + u));
  const double b_2 = u * u * (3.0 - 2.0 * u);
  const double b_3 = u * u * u;
  return (q0 * rotation_of(w_1 * b_1) * rotation_of(w_2 * b_2) * rotation_of(w_3 * b_3)).normalized();
}

}  // namespace

PathInterpolator::PathInterpolator(Path path, Interpolation interpolation, double gap_intervals)
    : path_(std::move(path)),
      interpolation_(interpolation),
      sample_interval_(std::numeric_limits<double>::quiet_NaN()) {
  if (path_.empty()) throw std::invalid_argument("a path needs at least one pose");
  find_gaps(gap_intervals);
  if (interpolation_ == Interpolation::LINEAR) return;
  std::size_t first = 0;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const bool ends = i + 1 == path_.size() || held_[i];
    if (!ends) continue;
    add_slopes(first, i);
    first = i + 1;
  }
}

void PathInterpolator::find_gaps(double gap_intervals) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) steps.push_back(path_[i + 1].time - path_[i].time);
  held_.assign(steps.size(), false);
  if (steps.empty()) return;
  sample_interval_ = median(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    held_[i] = gap_intervals > 0.0 && steps[i] > gap_intervals * sample_interval_;
    if (held_[i]) gaps_.push_back({path_[i].time, steps[i]});
  }
}

/// Slopes of the poses first to last, between which there is no gap.
void PathInterpolator::add_slopes(std::size_t first, std::size_t last) {
  std::vector<double> steps;
  std::vector<Vec3> secants;
  std::vector<Vec3> angular_secants;
  for (std::size_t i = first; i < last; ++i) {
    const Pose& a = path_[i].pose;
    const Pose& b = path_[i + 1].pose;
    steps.push_back(path_[i + 1].time - path_[i].time);
    secants.push_back((b.translation - a.translation) / steps.back());
    angular_secants.push_back(rotation_vector_of(a.rotation.conjugate() * b.rotation) / steps.back());
  }
  const auto append = [](std::vector<Vec3>& all, const std::vector<Vec3>& slopes) {
    all.insert(all.end(), slopes.begin(), slopes.end());
  };
  append(velocities_, parabola_slopes(steps, secants));
  append(angular_velocities_, parabola_slopes(steps, angular_secants));
}

Pose PathInterpolator::at(double time) const {
  LMDBENCH_EXPECTS(!std::isnan(time), "a time that was divided by no time");
  const auto next = std::upper_bound(path_.begin(), path_.end(), time,
                                     [](double t, const TimedPose& timed) { return t < timed.time; });
  if (next == path_.begin()) return path_.front().pose;
  LMDBENCH_EXPECTS(held_.size() + 1 >= path_.size(), "an interpolator that was moved from");
  const auto index = static_cast<std::size_t>(next - path_.begin()) - 1;
  const TimedPose& a = path_[index];
  if (next == path_.end() || time == a.time || held_[index]) return a.pose;
  const TimedPose& b = *next;
  const double step = b.time - a.time;
  const double u = (time - a.time) / step;
  if (interpolation_ == Interpolation::LINEAR) {
    const Vec3 turn = rotation_vector_of(a.pose.rotation.conjugate() * b.pose.rotation);
    return {a.pose.translation + u * (b.pose.translation - a.pose.translation),
            (a.pose.rotation * rotation_of(u * turn)).normalized()};
  }
  return {hermite(a.pose.translation, step * velocities_[index], b.pose.translation,
                  step * velocities_[index + 1], u),
          bezier(a.pose.rotation, step * angular_velocities_[index], b.pose.rotation,
                 step * angular_velocities_[index + 1], u)};
}

std::size_t frame_count(const PathInterpolator& interpolator, double rate) {
  if (!(rate > 0.0) || !std::isfinite(rate)) throw std::invalid_argument("the frame rate must be above 0");
  const double periods = (interpolator.end_time() - interpolator.start_time()) * rate;
  // Times since 1970 are themselves rounded to 2e-7 s.
  const double latest = std::max(std::abs(interpolator.start_time()), std::abs(interpolator.end_time()));
  const double rounding = std::numeric_limits<double>::epsilon() * latest * rate;
  return static_cast<std::size_t>(std::floor(periods + std::max(LAST_FRAME_TOLERANCE, rounding))) + 1;
}

void refuse_too_many_frames(const PathInterpolator& interpolator, double rate,
                            std::optional<std::size_t> most, const std::string& file) {
  const double duration = interpolator.end_time() - interpolator.start_time();
  const double whole = std::floor(duration * rate) + 1.0;
  const double frames = most ? std::min(whole, static_cast<double>(*most)) : whole;
  if (frames <= static_cast<double>(limit_of(Limit::FRAMES))) return;  // false for NaN, too
  throw InputError(
      file, "",
      fmt::format("lasts {:g} s: {:.15g} frames at {:g} Hz, above the limit of {}", duration, frames, rate,
                  limit_of(Limit::FRAMES)),
      "give times in seconds, a lower frame rate or fewer frames, or " + raise_remedy(Limit::FRAMES));
}

Path resample(const PathInterpolator& interpolator, double rate, std::optional<std::size_t> most) {
  const double periods = (interpolator.end_time() - interpolator.start_time()) * rate;
  // Without a count where the limit decides: the count need not fit an integer.
  const bool cut = most && periods >= static_cast<double>(*most);
  std::size_t count = cut ? *most : frame_count(interpolator, rate);
  if (most) count = std::min(count, *most);
  Path frames;
  frames.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double time = interpolator.start_time() + static_cast<double>(k) / rate;
    Pose pose = interpolator.at(time);
    if (k > 0 && pose.rotation.dot(frames.back().pose.rotation) < 0.0) pose.rotation.coeffs() *= -1.0;
    frames.push_back({time, pose});
  }
  return frames;
}

Pose extrapolated(const Pose& before, const Pose& now, double frames) {
  LMDBENCH_EXPECTS(std::isfinite(frames), "a time that was divided by no time");
  const Vec3 turn_W = rotation_vector_of(now.rotation * before.rotation.conjugate());
  return {now.translation + frames * (now.translation - before.translation),
          (rotation_of(frames * turn_W) * now.rotation).normalized()};
}

}  // namespace lmdbench
