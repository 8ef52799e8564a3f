// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// A number that every point of a sweep has, or NaN.
struct PointNumber {
  std::string_view name;  ///< Of the dataset and the JSON key; ends in its unit where it has one.
  std::string_view units;
  std::string_view long_name;
};

/// All of them: a run's summary, the steps, the times; in the order of reports.
const std::vector<PointNumber>& point_numbers();

/// What one traversal of a path by a point leaves, as the journal keeps it. Times are whole nanoseconds, which is what
/// the clock tells.
struct PointRun {
  std::string result_hash;  ///< Equal in every repetition, as is the next.
  std::string work_hash;
  RepetitionTimes times;

  nlohmann::json to_json() const;
  static PointRun from_json(const nlohmann::json& json);
};

/// What is the same in every repetition, of the first one.
struct PointErrors {
  std::map<std::string, double> numbers;         ///< NaN is left out.
  std::map<std::string, std::int64_t> counters;  ///< Sums over the path, of the local and the global part.
  std::vector<bool> counts;                      ///< Frames in contact that count.
  std::vector<std::int64_t> tracked;             ///< LMDs carried, one a frame.
  std::vector<std::int64_t> search_frames;
  std::vector<double> force;  ///< Length of the rendered force, one a frame [N].
  std::int64_t truth_checked_frames = 0;
  std::int64_t truth_wrong_frames = 0;

  nlohmann::json to_json() const;
  static PointErrors from_json(const nlohmann::json& json);
  /// Whether a traversal has as many frames and searches, each within the path.
  bool fits(const PointRun& run) const;
};

/// A point when all its repetitions are done, or when it failed.
struct PointResult {
  std::string failure;  ///< Why it has no numbers; empty where it has.
  std::string result_hash;
  PointErrors errors;
  std::map<std::string, double> numbers;  ///< Errors and times.
  std::vector<RepetitionTimes> repetitions;
  std::string where_json;  ///< JSON array: where and beside what each repetition was timed (node_watch.h).
  /// Traversals that began; more than the repetitions where some were cut off or done twice, and 0 for a failure.
  std::int64_t begun = 0;

  double number(std::string_view name) const;  ///< NaN where it was not measured.
};

/// Puts errors and times together.
PointResult finish_point(PointErrors errors, const std::vector<PointRun>& runs, double frame_rate_hz);

}  // namespace lmdbench
