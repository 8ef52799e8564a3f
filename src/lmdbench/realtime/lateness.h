// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// Lateness of a loop, and its excess over the floor.
namespace lmdbench {

/// Quantiles that reports show.
inline constexpr std::array<double, 5> LATENESS_SHARES{0.5, 0.95, 0.99, 0.999, 0.9999};

/// A quantile, its 95 % interval [s] and the samples above: p99.99 of 60,000 samples rests on six.
struct LatenessQuantile {
  double share = 0.0;
  double value = 0.0, low = 0.0, high = 0.0;
  std::int64_t above = 0;
};

/// A quantile of one loop minus that of another [s], with its 95 % interval.
struct LatenessExcess {
  double share = 0.0;
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Lateness of one loop [s] by instant of its grid, with resamples of its quantiles (nearest rank).
/// Where the machine is taken away for milliseconds, neighbouring samples depend on each other. So
/// whole blocks of LATENESS_BLOCK samples are drawn (block bootstrap; Kunsch 1989), the same draws
/// in every run.
class Lateness {
 public:
  /// @param seconds  one an instant, in order
  explicit Lateness(std::span<const double> seconds);

  std::vector<LatenessQuantile> quantiles() const;
  /// By how much this loop is later than the floor.
  std::vector<LatenessExcess> excess_over(const Lateness& floor) const;
  double maximum() const;  ///< NaN without samples.
  std::size_t size() const { return sorted_.size(); }

 private:
  static constexpr std::size_t RESAMPLES = 400;

  std::vector<double> sorted_;
  std::array<std::vector<double>, LATENESS_SHARES.size()> resampled_;
};

/// Samples of a block: 0.1 s at 1 kHz, longer than the few milliseconds of an interruption.
inline constexpr std::size_t LATENESS_BLOCK = 100;

/// Upper edges of the histogram's bins [s], 10 a decade from 1 us to 1 s; one more bin is above.
std::vector<double> lateness_edges();
/// Counts by bin: at or below each edge and above the one before; the last bin is above all edges.
std::vector<std::int64_t> lateness_histogram(std::span<const double> seconds);

}  // namespace lmdbench
