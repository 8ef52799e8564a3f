// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/metrics/cleanliness.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

namespace lmdbench {
namespace {

/// Hann-weighted root mean square, about the weighted mean or about zero.
double weighted_rms(std::span<const Vec3> values, bool about_mean) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(values.size());
  const auto weight = [&](std::size_t i) { return 1.0 - std::cos(step * (static_cast<double>(i) + 0.5)); };
  double weights = 0.0;
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < values.size(); ++i) {
    weights += weight(i);
    if (about_mean) mean += weight(i) * values[i];
  }
  mean /= weights;
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weight(i) * (values[i] - mean).squaredNorm();
  return std::sqrt(sum / weights);
}

/// ln(second / first); a measure that is 0 in both windows does not grow.
double growth(double first, double second) {
  if (second == 0.0) return -std::numeric_limits<double>::max();
  if (first == 0.0) return std::numeric_limits<double>::max();
  return std::log(second / first);
}

/// Oscillations a second: of the velocity's sign changes in the direction of most motion, from the
/// first one to the last, each at its place between two frames.
double frequency(std::span<const Vec3> velocity, double period) {
  Mat3 spread = Mat3::Zero();
  for (const Vec3& v : velocity) spread += v * v.transpose();
  int axis = 0;
  spread.diagonal().maxCoeff(&axis);
  std::vector<double> changes;  // in frames
  // With friction the device may stop for some frames where it turns back.
  std::size_t last = 0;
  for (std::size_t i = 1; i < velocity.size(); ++i) {
    const double before = velocity[last][axis], after = velocity[i][axis];
    if (before * after < 0.0)
      changes.push_back(static_cast<double>(i) - static_cast<double>(i - last) * after / (after - before));
    if (after != 0.0 || before == 0.0) last = i;
  }
  if (changes.size() < 2) return 0.0;
  return static_cast<double>(changes.size() - 1) / (2.0 * period * (changes.back() - changes.front()));
}

}  // namespace

std::vector<Vec3> above_30_hz(const std::vector<Vec3>& signal, double period_s) {
  // Bilinear transform.
  const double w = std::tan(std::numbers::pi * HIGH_PASS_HZ * period_s);
  LMDBENCH_EXPECTS(period_s > 0.0 && 2.0 * HIGH_PASS_HZ * period_s < 1.0, "a rate that cannot render 30 Hz");
  const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
  const double a1 = 2.0 * (w * w - 1.0) * scale;
  const double a2 = (1.0 - std::numbers::sqrt2 * w + w * w) * scale;
  std::vector<Vec3> result;
  result.reserve(signal.size());
  Vec3 x1 = signal.empty() ? Vec3(Vec3::Zero()) : signal.front();
  Vec3 x2 = x1;
  Vec3 y1 = Vec3::Zero();
  Vec3 y2 = Vec3::Zero();
  for (const Vec3& x : signal) {
    const Vec3 y = scale * (x - 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1;
    x1 = x;
    y2 = y1;
    y1 = y;
    result.push_back(y);
  }
  return result;
}

std::string_view to_string(CleanMeasure measure) {
  switch (measure) {
    case CleanMeasure::AMPLITUDE:
      return "amplitude";
    case CleanMeasure::ENERGY:
      return "energy";
    case CleanMeasure::FORCE_ABOVE_30_HZ:
      return "force_above_30_hz";
  }
  return "";
}

Cleanliness judge(const Swing& swing) {
  const std::size_t frames = swing.position_W.size();
  LMDBENCH_EXPECTS(swing.velocity_W.size() == frames && swing.force_W.size() == frames,
                   "parallel arrays of unlike lengths");
  const std::size_t window = frames * WINDOW_CYCLES / (SKIPPED_CYCLES + 2 * WINDOW_CYCLES);
  assert(window > 0 && "too short a swing");
  const auto windows = [&](const std::vector<Vec3>& values, bool about_mean) {
    const std::span<const Vec3> all(values);
    return std::pair(weighted_rms(all.subspan(frames - 2 * window, window), about_mean),
                     weighted_rms(all.subspan(frames - window, window), about_mean));
  };
  std::array<double, CLEAN_MEASURE_COUNT> growths{};
  growths.fill(-std::numeric_limits<double>::max());
  const auto grown = [&](CleanMeasure measure, const std::pair<double, double>& both) {
    growths[static_cast<std::size_t>(measure)] = growth(both.first, both.second);
  };
  const std::pair<double, double> amplitude = windows(swing.position_W, true);
  grown(CleanMeasure::AMPLITUDE, amplitude);
  grown(CleanMeasure::ENERGY, windows(swing.velocity_W, false));
  if (2.0 * HIGH_PASS_HZ * swing.period_s < 1.0)
    grown(CleanMeasure::FORCE_ABOVE_30_HZ, windows(above_30_hz(swing.force_W, swing.period_s), false));

  Cleanliness result;
  result.growth = growths.front();
  for (std::size_t i = 1; i < CLEAN_MEASURE_COUNT; ++i) {
    if (growths[i] <= result.growth) continue;
    result.growth = growths[i];
    result.fastest = static_cast<CleanMeasure>(i);
  }
  result.amplitude_m = amplitude.second;
  result.frequency_hz =
      frequency(std::span(swing.velocity_W).subspan(frames - 2 * window, 2 * window), swing.period_s);
  if (result.amplitude_m < swing.resolution_m) result.growth = std::min(result.growth, 0.0);
  return result;
}

}  // namespace lmdbench
