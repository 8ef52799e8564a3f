// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/records.h>

#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// One method's numbers of a run, NaN for what was not measured. They are computed once, here, and printed,
/// written into the result file and read by scripts under the same names; results/README.md tells each
/// definition, errors.h and times.h the details.
struct MethodSummary {
  std::string label;
  std::string result_hash;
  std::string entry;    ///< The label without the profile.
  std::string profile;  ///< Name of its force profile; empty for one alone.

  double frames_in_contact = UNSET;
  double frames_touching = UNSET;
  double lmd_count_median = UNSET;
  double lmd_count_p99 = UNSET;
  double lmd_count_maximum = UNSET;
  double candidates_median = UNSET;
  double reduction_ratio = UNSET;
  double reduction_ratio_maximum = UNSET;

  double rendered_force_median_n = UNSET;
  double rendered_force_p99_n = UNSET;
  double rendered_force_maximum_n = UNSET;
  double force_clipped_share = UNSET;
  double force_above_30_hz_n = UNSET;
  double effective_stiffness_p99_n_per_m = UNSET;
  double dropouts = UNSET;
  double dropouts_per_second = UNSET;
  double dropouts_per_second_low = UNSET;
  double dropouts_per_second_high = UNSET;
  double energy_created_j = UNSET;
  double energy_balance_error = UNSET;

  double recall = UNSET;
  double recall_adjacent = UNSET;
  double precision = UNSET;
  double precision_adjacent = UNSET;
  double frames_wrong = UNSET;
  double minimum_distance_error_maximum_m = UNSET;
  double force_error_rms_n = UNSET;
  double force_error_median_n = UNSET;
  double force_error_p99_n = UNSET;
  double force_error_maximum_n = UNSET;
  double force_angle_error_median_rad = UNSET;
  double force_jump_p99_n = UNSET;
  double force_jump_maximum_n = UNSET;
  double true_force_jump_p99_n = UNSET;
  double true_force_jump_maximum_n = UNSET;
  double jumps = UNSET;
  double jumps_per_second = UNSET;
  double jumps_per_second_low = UNSET;
  double jumps_per_second_high = UNSET;
  double true_jumps = UNSET;
  double true_jump_frames = UNSET;
  double true_jumps_per_second = UNSET;
  double true_jumps_per_second_low = UNSET;
  double true_jumps_per_second_high = UNSET;

  double local_update_median_s = UNSET;
  double local_update_p99_s = UNSET;
  double local_update_maximum_s = UNSET;
  double global_search_median_s = UNSET;
  double global_search_p99_s = UNSET;
  double first_reduction_median_s = UNSET;
  double second_tracking_median_s = UNSET;
  double search_with_reduction_median_s = UNSET;
  double search_with_reduction_p99_s = UNSET;
  double frame_time_median_s = UNSET;
  double frame_time_p99_s = UNSET;
  double frame_time_maximum_s = UNSET;
  double frames_late = UNSET;
};

/// A number of the summary with what a reader must know of it.
struct SummaryNumber {
  std::string_view name;   ///< Of the dataset and the JSON key; ends in its unit where it has one.
  std::string_view units;  ///< SI symbol, "1" for counts and ratios.
  std::string_view long_name;
  double MethodSummary::*value;
  /// Made of times although its unit is not one: different in every run.
  bool counts_times = false;

  bool made_of_times() const { return units == "s" || counts_times; }
};

/// All numbers, in the order of reports.
std::span<const SummaryNumber> summary_numbers();

}  // namespace lmdbench
