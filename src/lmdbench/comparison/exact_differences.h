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

/// A place where two results that should be equal differ: the first such row of one dataset.
struct Difference {
  std::string method;   ///< Label; empty for data of no method (experiment, inputs, truth)
  std::string dataset;  ///< In the method's group ("force", "counters/node_pairs"), else absolute
  std::optional<std::int64_t> frame;  ///< Haptic frame; unset for a whole dataset or attribute
  nlohmann::json base;                ///< Value: number, text, row; null: NaN or absent
  nlohmann::json candidate;
  std::size_t rows = 0;  ///< Rows of the dataset that differ, with this one; 0: no rows
};

/// In place of a value: what one side alone has.
inline constexpr const char* PRESENT = "present";
inline constexpr const char* ABSENT = "absent";
/// The dataset with the experiment as JSON.
inline constexpr const char* EXPERIMENT = "/provenance/experiment";

/// The experiment of a result, resolved; no object where the file does not tell.
nlohmann::json recorded_experiment(const ResultReader& file);

/// The order of reports: data of no method, then by frame, so that the first entry is nearest to
/// the cause; whole datasets last.
inline bool reported_before(const Difference& a, const Difference& b) {
  const auto key = [](const Difference& d) {
    return std::tuple(!d.method.empty(), d.frame.value_or(std::numeric_limits<std::int64_t>::max()), d.method,
                      d.dataset);
  };
  return key(a) < key(b);
}

/// The haptic frame of a row of a dataset, from other datasets (results/README.md): `frame` or
/// `frame_offset` of its own group or the one around it, `global_frame` of the method for one row a
/// search, and the row itself for one row a frame.
/// @param group   "/methods/improved", or "/reference"
/// @param dataset path inside the group
/// @return unset where the file does not tell
std::optional<std::int64_t> frame_of_row(const ResultReader& file, const std::string& group,
                                         const std::string& dataset, std::size_t row);

struct ExactOptions {
  /// Allowed difference over the largest magnitude in a row; 0: same bits. NaN equals NaN.
  double tolerance_relative = 0.0;
  std::vector<std::string> allowed_counters;  ///< Counters that may differ
};

/// Compares every deterministic dataset of every method, matched by label in any order: LMD sets,
/// forces, counters, errors against truth; no times. Also what all methods share: truth, FCL's
/// cross-check, polylines, summary, frames in contact. A method or dataset of the candidate alone
/// is no difference; one that it lost is, unless it is a counter that was 0 throughout, or the run
/// was asked to keep none (`kept_differences`). Where lists of frames differ, rows of one frame are
/// compared, and the lists, unless the runs were asked for other frames. Numbers of true steps are
/// left out without `same_true_steps`.
/// @return at most one entry a dataset, in the order of `reported_before`
std::vector<Difference> exact_differences(const ResultReader& base, const ResultReader& candidate,
                                          const ExactOptions& options);

/// Whether the true force is known in every frame of both or of neither: a method that finds the
/// complete set tells it for all methods, and jumps are then counted over more frames.
bool same_true_steps(const ResultReader& base, const ResultReader& candidate);

/// The same for a group outside the methods, such as /path; bit by bit.
std::vector<Difference> group_differences(const ResultReader& base, const ResultReader& candidate,
                                          const std::string& group);

/// Parts of the candidate alone, unless the base was asked to keep none: "method certified",
/// "improved/counters/new_counter", "/polylines".
std::vector<std::string> additions(const ResultReader& base, const ResultReader& candidate);

/// Names of the counters that a file holds, sorted.
std::vector<std::string> counters_of(const ResultReader& file);

}  // namespace lmdbench
