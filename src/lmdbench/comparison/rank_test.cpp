// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/rank_test.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

/// Twice the rank of every value of the pooled sample, base first; tied values share the mean rank, and twice a mean
/// rank is an integer.
std::vector<std::size_t> doubled_midranks(std::span<const double> base, std::span<const double> candidate) {
  std::vector<double> pooled(base.begin(), base.end());
  pooled.insert(pooled.end(), candidate.begin(), candidate.end());
  std::vector<double> sorted = pooled;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> ranks;
  ranks.reserve(pooled.size());
  for (const double value : pooled) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), value);
    ranks.push_back(static_cast<std::size_t>((first - sorted.begin()) + (last - sorted.begin()) + 1));
  }
  return ranks;
}

/// ways[s]: number of ways to choose `count` of the ranks with sum s. Doubles: the numbers outgrow integers, and only
/// their ratios are used.
std::vector<double> ways_by_sum(const std::vector<std::size_t>& ranks, std::size_t count) {
  const std::size_t total = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  std::vector<std::vector<double>> ways(count + 1, std::vector<double>(total + 1, 0.0));
  ways[0][0] = 1.0;
  for (std::size_t used = 0; used < ranks.size(); ++used) {
    const std::size_t rank = ranks[used];
    for (std::size_t k = std::min(count, used + 1); k > 0; --k)
      for (std::size_t sum = rank; sum <= total; ++sum) ways[k][sum] += ways[k - 1][sum - rank];
  }
  return ways[count];
}

}  // namespace

RankTest rank_test(std::span<const double> base, std::span<const double> candidate) {
  const std::vector<std::size_t> ranks = doubled_midranks(base, candidate);
  const auto of_candidate = ranks.begin() + static_cast<std::ptrdiff_t>(base.size());
  const std::size_t observed = std::accumulate(of_candidate, ranks.end(), std::size_t{0});
  const std::vector<double> ways = ways_by_sum(ranks, candidate.size());
  const double all = std::accumulate(ways.begin(), ways.end(), 0.0);
  const auto split = ways.begin() + static_cast<std::ptrdiff_t>(observed);
  RankTest test;
  test.p_larger = std::accumulate(split, ways.end(), 0.0) / all;
  test.p_smaller = std::accumulate(ways.begin(), split + 1, 0.0) / all;
  const std::size_t smallest = candidate.size() * (candidate.size() + 1);  // doubled ranks 2, 4, ...
  test.agreement = static_cast<double>(observed - smallest) / 2.0 /
                   (static_cast<double>(base.size()) * static_cast<double>(candidate.size()));
  return test;
}

}  // namespace lmdbench
