// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace lmdbench {
namespace {

std::vector<double> set_values(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
               values.end());
  return values;
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  LMDBENCH_EXPECTS(share >= 0.0 && share <= 1.0, "per cent in place of a share");
  values = set_values(std::move(values));
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double position = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double fraction = position - static_cast<double>(below);
  // Equal neighbours (also two infinities) are returned as they are: interpolation
  // would make NaN of infinities.
  if (fraction == 0.0 || values[below] == values[above]) return values[below];
  return values[below] + fraction * (values[above] - values[below]);
}

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

double mean(const std::vector<double>& values) {
  const std::vector<double> set = set_values(values);
  if (set.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(set.begin(), set.end(), 0.0) / static_cast<double>(set.size());
}

double maximum(const std::vector<double>& values) {
  const std::vector<double> set = set_values(values);
  if (set.empty()) return std::numeric_limits<double>::quiet_NaN();
  return *std::max_element(set.begin(), set.end());
}

}  // namespace lmdbench
