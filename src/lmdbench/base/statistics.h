// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace lmdbench {

/// The one definition of quantiles, of results, studies and benchmarks alike: `share` in [0, 1] of the values
/// lies at or below the result, linearly interpolated between neighbours (numpy's default). NaN values are
/// unset and do not count; NaN when nothing is left.
double quantile(std::vector<double> values, double share);

/// Share of the quantile that reports show as p99.
inline constexpr double P99 = 0.99;

/// quantile(values, 0.5)
double median(std::vector<double> values);

/// Mean of the values that are set; NaN when none is.
double mean(const std::vector<double>& values);

/// Largest of the values that are set; NaN when none is.
double maximum(const std::vector<double>& values);

}  // namespace lmdbench
