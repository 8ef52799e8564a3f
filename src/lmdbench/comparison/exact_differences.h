// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/difference.h>
#include <lmdbench/result_file/result_reader.h>

#include <string>
#include <vector>

namespace lmdbench {

struct ExactOptions {
  /// Real numbers may differ by this share of the largest magnitude in their row; 0: the same bits. NaN equals NaN.
  double tolerance_relative = 0.0;
  std::vector<std::string> allowed_counters;  ///< Counters that may differ
};

/// Every deterministic dataset of every method, matched by label, so that another order of methods is no difference: LMD
/// sets, forces, counters, errors against truth; times are left out. A method or dataset that only the candidate has is
/// no difference, one that it has lost is, unless it is a counter that was 0 throughout.
/// @return at most one entry a dataset, in the order of `reported_before`
std::vector<Difference> exact_differences(const ResultReader& base, const ResultReader& candidate,
                                          const ExactOptions& options);

/// The same for a group outside the methods, such as /path; bit by bit.
std::vector<Difference> group_differences(const ResultReader& base, const ResultReader& candidate,
                                          const std::string& group);

/// What only the candidate has: "method certified", "improved/counters/new_counter".
std::vector<std::string> additions(const ResultReader& base, const ResultReader& candidate);

/// Names of the counters that a file holds, sorted.
std::vector<std::string> counters_of(const ResultReader& file);

}  // namespace lmdbench
