// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/noise_floor.h>
#include <lmdbench/comparison/ratio_estimate.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::size_t REPETITIONS = 3;
constexpr std::size_t PIECES = 50;
/// As many as scripts/ci_regression.sh starts with, and its probability of a false alarm shared out among seven stages.
constexpr std::size_t PROCESSES = 6;
constexpr double FALSE_ALARM = 0.05 / 7.0;

/// Some 0.1 ms of dependent arithmetic over a table that fills half of a usual level 1 and part of a level 2 cache:
/// feels a lower frequency as well as a neighbour in the cache.
class Piece {
 public:
  Piece() : table_(TABLE_SIZE) { std::iota(table_.begin(), table_.end(), 1.0); }

  double run() {
    std::uint64_t state = 88172645463325252ULL;
    double sum = 0.0;
    for (int i = 0; i < STEPS; ++i) {
      state ^= state << 13;  // xorshift64 (Marsaglia 2003)
      state ^= state >> 7;
      state ^= state << 17;
      sum = sum * 0.5 + table_[state % TABLE_SIZE];
    }
    return sum;
  }

 private:
  static constexpr std::size_t TABLE_SIZE = 16384;  // 128 KiB
  static constexpr int STEPS = 20000;
  std::vector<double> table_;
};

/// What `lmdbench compare` would call detectable if consecutive groups were processes of two sides in turns: the median over
/// all such sets of 2 x PROCESSES groups. NaN where there are fewer.
double median_detectable(const std::vector<double>& groups) {
  std::vector<double> found;
  for (std::size_t first = 0; first + 2 * PROCESSES <= groups.size(); first += 2 * PROCESSES) {
    std::vector<double> base, candidate;
    for (std::size_t i = 0; i < 2 * PROCESSES; ++i)
      (i % 2 == 0 ? base : candidate).push_back(groups[first + i]);
    found.push_back(estimate_ratio(base, candidate, FALSE_ALARM).detectable);
  }
  return found.empty() ? std::numeric_limits<double>::quiet_NaN() : median(found);
}

}  // namespace

NoiseFloor summarise_noise(std::span<const double> times, std::size_t repetitions, std::size_t pieces) {
  const std::size_t group_size = repetitions * pieces, groups = times.size() / group_size;
  const double least = *std::min_element(times.begin(), times.end());
  std::vector<double> excess;
  excess.reserve(times.size());
  for (const double time : times) excess.push_back(time / least - 1.0);
  std::vector<double> sums, logarithms;
  for (std::size_t group = 0; group < groups; ++group) {
    double sum = 0.0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      double smallest = times[group * group_size + piece];
      for (std::size_t r = 1; r < repetitions; ++r)
        smallest = std::min(smallest, times[group * group_size + r * pieces + piece]);
      sum += smallest;
    }
    sums.push_back(sum);
    logarithms.push_back(std::log(sum));
  }
  const double centre = mean(logarithms);
  double squares = 0.0;
  for (const double value : logarithms) squares += (value - centre) * (value - centre);
  NoiseFloor floor;
  floor.seconds = std::accumulate(times.begin(), times.end(), 0.0);
  floor.piece_seconds = least;
  floor.typical_excess = median(excess);
  floor.slow_excess = quantile(excess, P99);
  floor.spread = std::sqrt(squares / static_cast<double>(groups - 1));
  floor.processes = PROCESSES;
  floor.detectable = median_detectable(sums);
  return floor;
}

NoiseFloor measure_noise_floor(double seconds) {
  using Clock = std::chrono::steady_clock;
  Piece piece;
  volatile double kept = piece.run();  // warms up, and keeps the compiler from dropping the work
  std::vector<double> times;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (std::size_t groups = 0; groups < 2 || Clock::now() < end; ++groups) {
    for (std::size_t i = 0; i < REPETITIONS * PIECES; ++i) {
      const auto begin = Clock::now();
      kept = piece.run();
      times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }
  }
  static_cast<void>(kept);
  return summarise_noise(times, REPETITIONS, PIECES);
}

}  // namespace lmdbench
