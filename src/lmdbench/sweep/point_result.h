// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// A number of every point of a sweep; may be NaN.
struct PointNumber {
  std::string_view name;  ///< Of the dataset and the JSON key; ends in its unit where it has one.
  std::string_view units;
  std::string_view long_name;
  bool made_of_times;  ///< Different in every sweep.
};

/// Adds the numbers of a table that are not NaN, by their names.
template <typename Numbers, typename Infos>
void add_known(std::map<std::string, double>& into, const Numbers& numbers, const Infos& infos) {
  for (const auto& info : infos)
    if (const double value = numbers.*info.value; !std::isnan(value)) into[std::string(info.name)] = value;
}

/// All of them: a run's summary, the steps, the times; in the order of reports.
const std::vector<PointNumber>& point_numbers();

/// One traversal of a path by a point, as the journal keeps it. Times are whole nanoseconds, the
/// resolution of the clock.
struct PointRun {
  std::string result_hash;  ///< Equal in all repetitions, as the next.
  std::string work_hash;
  RepetitionTimes times;

  nlohmann::json to_json() const;
  static PointRun from_json(const nlohmann::json& json);
};

/// Results that all repetitions share, from the first one.
struct PointErrors {
  std::map<std::string, double> numbers;         ///< NaN is left out.
  std::map<std::string, std::int64_t> counters;  ///< Sums over the path, local and global.
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

/// A point that has all its repetitions, or has failed.
struct PointResult {
  std::string failure;  ///< Why there are no numbers; else empty.
  std::string result_hash;
  PointErrors errors;
  std::map<std::string, double> numbers;  ///< Errors and times.
  std::vector<RepetitionTimes> repetitions;
  std::string where_json;  ///< JSON array: node and load of each repetition.
  /// Traversals begun: more than repetitions if some were cut off or repeated; 0 for a failure.
  std::int64_t begun = 0;

  double number(std::string_view name) const;  ///< NaN if unmeasured.
};

/// Puts errors and times together.
/// @param runs that agree
PointResult finish_point(PointErrors errors, const std::vector<PointRun>& runs, double frame_rate_hz);

}  // namespace lmdbench
