// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/lateness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>

namespace lmdbench {
namespace {

constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();
constexpr double LOW = 0.025, HIGH = 0.975;

/// Index of the smallest value with so large a share of the samples at or below it.
std::size_t rank_of(double share, std::size_t count) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(count)));
  return std::min(std::max<std::size_t>(rank, 1), count) - 1;
}

double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return UNKNOWN;
  std::sort(values.begin(), values.end());
  return values[rank_of(share, values.size())];
}

}  // namespace

Lateness::Lateness(std::span<const double> seconds) {
  std::vector<std::size_t> order(seconds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return seconds[a] < seconds[b]; });
  sorted_.reserve(seconds.size());
  for (const std::size_t i : order) sorted_.push_back(seconds[i]);
  if (sorted_.empty()) return;
  // Blocks have weights: one pass over the sorted samples gives every quantile of a resample.
  const std::size_t blocks = (seconds.size() + LATENESS_BLOCK - 1) / LATENESS_BLOCK;
  std::mt19937_64 random(seconds.size());
  std::vector<std::int64_t> weight(blocks);
  for (std::size_t resample = 0; resample < RESAMPLES; ++resample) {
    std::fill(weight.begin(), weight.end(), 0);
    std::int64_t total = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::size_t block = random() % blocks;
      ++weight[block];
      total += static_cast<std::int64_t>(std::min(LATENESS_BLOCK, seconds.size() - block * LATENESS_BLOCK));
    }
    std::int64_t below = 0;
    std::size_t next = 0;
    for (std::size_t k = 0; k < order.size() && next < LATENESS_SHARES.size(); ++k) {
      below += weight[order[k] / LATENESS_BLOCK];
      while (next < LATENESS_SHARES.size() &&
             below >
                 static_cast<std::int64_t>(rank_of(LATENESS_SHARES[next], static_cast<std::size_t>(total))))
        resampled_[next++].push_back(sorted_[k]);
    }
  }
}

std::vector<LatenessQuantile> Lateness::quantiles() const {
  std::vector<LatenessQuantile> result;
  for (std::size_t i = 0; i < LATENESS_SHARES.size(); ++i) {
    LatenessQuantile quantile{LATENESS_SHARES[i], UNKNOWN, UNKNOWN, UNKNOWN, 0};
    if (!sorted_.empty()) {
      quantile.value = sorted_[rank_of(quantile.share, sorted_.size())];
      quantile.low = quantile_of(resampled_[i], LOW);
      quantile.high = quantile_of(resampled_[i], HIGH);
      quantile.above = sorted_.end() - std::upper_bound(sorted_.begin(), sorted_.end(), quantile.value);
    }
    result.push_back(quantile);
  }
  return result;
}

std::vector<LatenessExcess> Lateness::excess_over(const Lateness& floor) const {
  std::vector<LatenessExcess> result;
  const std::vector<LatenessQuantile> own = quantiles(), others = floor.quantiles();
  for (std::size_t i = 0; i < LATENESS_SHARES.size(); ++i) {
    LatenessExcess excess{LATENESS_SHARES[i], UNKNOWN, UNKNOWN, UNKNOWN};
    if (!sorted_.empty() && !floor.sorted_.empty()) {
      excess.value = own[i].value - others[i].value;
      std::vector<double> differences;
      for (std::size_t k = 0; k < RESAMPLES; ++k)
        differences.push_back(resampled_[i][k] - floor.resampled_[i][(k * 7 + 3) % RESAMPLES]);
      excess.low = quantile_of(differences, LOW);
      excess.high = quantile_of(differences, HIGH);
    }
    result.push_back(excess);
  }
  return result;
}

double Lateness::maximum() const {
  return sorted_.empty() ? UNKNOWN : sorted_.back();
}

std::vector<double> lateness_edges() {
  constexpr int DECADES = 6, BINS = 10;
  std::vector<double> edges;
  for (int i = 0; i <= DECADES * BINS; ++i)
    edges.push_back(1e-6 * std::pow(10.0, static_cast<double>(i) / BINS));
  return edges;
}

std::vector<std::int64_t> lateness_histogram(std::span<const double> seconds) {
  const std::vector<double> edges = lateness_edges();
  std::vector<std::int64_t> counts(edges.size() + 1, 0);
  for (const double value : seconds)
    ++counts[static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), value) - edges.begin())];
  return counts;
}

}  // namespace lmdbench
