// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/records.h>

#include <span>
#include <string_view>
#include <vector>

/// Times beyond those of a run's summary (experiment/times.h): what all of a second costs, and what an update costs
/// per LMD that it carries.
namespace lmdbench {

/// NaN for what was not measured. Over the frames that count, and the searches that start in one; a frame or search has
/// the median of its measured repetitions.
struct TimeNumbers {
  double processor_share = UNSET;  ///< Run time (wall clock) / time in contact.
  double local_update_mean_s = UNSET;
  double local_update_empty_median_s = UNSET;   ///< Frames whose set is empty.
  double local_update_filled_median_s = UNSET;  ///< The others.
  double local_update_filled_mean_s = UNSET;
  double local_update_per_tracked_s = UNSET;  ///< Time of all filled frames / LMDs that they carry.
  double search_share = UNSET;                ///< Of the run time, in searches and the trackings after them.
};

struct TimeNumber {
  std::string_view name;
  std::string_view units;
  std::string_view long_name;
  double TimeNumbers::*value;
};

/// All numbers, in the order of reports.
std::span<const TimeNumber> time_numbers();

/// @param record of which the searches' frames, the frames' tracked counts and the repetitions are read
/// @param counts one a frame
TimeNumbers measure_times(const MethodRecord& record, const std::vector<bool>& counts, double frame_rate_hz);

/// What reading the clock twice costs [s], the median of many: part of every time.
double clock_overhead();

}  // namespace lmdbench
