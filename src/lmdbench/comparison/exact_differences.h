// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace lmdbench {

/// A place where two results that should be the same are not: the first row of one dataset that differs.
struct Difference {
  std::string method;  ///< Label; empty for what belongs to no method (experiment, inputs, truth)
  std::string
      dataset;  ///< Path inside the method's group, "force" or "counters/node_pairs"; else an absolute path
  std::optional<std::int64_t> frame;  ///< Haptic frame; unset where the whole dataset or attribute differs
  nlohmann::json base;  ///< Value there: number, text or row of numbers; null for NaN and for "absent"
  nlohmann::json candidate;
  std::size_t rows = 0;  ///< Rows of the dataset that differ, this one included; 0 where there are no rows
};

/// The order of reports: what belongs to no method, then by frame, so that the first entry is nearest to the cause;
/// whole datasets last.
inline bool reported_before(const Difference& a, const Difference& b) {
  const auto key = [](const Difference& d) {
    return std::tuple(!d.method.empty(), d.frame.value_or(std::numeric_limits<std::int64_t>::max()), d.method,
                      d.dataset);
  };
  return key(a) < key(b);
}

/// The haptic frame that a row of a dataset belongs to, by the datasets that say so (results/README.md): `frame` or
/// `frame_offset` of the dataset's own group, `global_frame` of the method for what has one row a search, and the row
/// itself for what has one row a frame.
/// @param group   "/methods/improved", or "/reference"
/// @param dataset path inside the group
/// @return unset where the file does not tell
std::optional<std::int64_t> frame_of_row(const ResultReader& file, const std::string& group,
                                         const std::string& dataset, std::size_t row);

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
