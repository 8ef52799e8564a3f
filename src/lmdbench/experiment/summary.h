// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/run.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lmdbench {

/// One method's figures of a run; NaN for what was not measured. Times leave the warm-up out. They are never
/// shown without the errors beside them.
struct MethodSummary {
  std::string label;
  std::string result_hash;
  double lmd_count_median = UNSET;  ///< Over the frames with at least one LMD.
  std::int64_t lmd_count_maximum = 0;
  double candidates_median = UNSET;       ///< Over the searches that found any.
  double reduction_ratio_median = UNSET;  ///< Candidates / LMDs kept, over the frames with at least one LMD.
  double reduction_ratio_maximum = UNSET;

  double recall_mean = UNSET;  ///< Over the probed frames with at least one true LMD.
  double precision_mean = UNSET;
  double recall_adjacent_mean = UNSET;
  double precision_adjacent_mean = UNSET;
  double minimum_distance_error_maximum_m = UNSET;  ///< Largest magnitude.
  /// Over the probed frames in which the method or truth has a force, so that free flight
  /// does not flatter the median.
  double force_error_median_n = UNSET;
  double force_error_p99_n = UNSET;
  double force_angle_error_median_rad = UNSET;
  double force_jump_p99_n = UNSET;
  double true_force_jump_p99_n = UNSET;

  /// Over the frames with at least one LMD, and over the searches that found any: free flight costs nothing.
  double local_update_median_s = UNSET;
  double local_update_p99_s = UNSET;
  double global_search_median_s = UNSET;
  double first_reduction_median_s = UNSET;
  double second_tracking_median_s = UNSET;
};

struct RunSummary {
  std::string name;
  std::int64_t frames = 0;
  std::int64_t probed_frames = 0;  ///< 0: no truth, errors are not measured.
  std::int64_t measured_repetitions = 0;
  double cutoff_m = UNSET;
  std::vector<MethodSummary> methods;
  std::int64_t fcl_frames = 0;  ///< Cross-checked frames; 0: not asked for.
  std::int64_t fcl_separated = 0;
  std::int64_t fcl_agreeing = 0;                       ///< Separated or not.
  std::map<std::string, std::int64_t> fcl_exceptions;  ///< By who was out of tolerance.

  double fcl_tolerance_relative = UNSET;
  std::vector<std::string> warnings;
};

RunSummary summarise(const Experiment& experiment, const RunResult& result);

/// For people.
std::string summary_text(const RunSummary& summary);

/// JSON text with the same figures, null for NaN.
std::string summary_json(const RunSummary& summary);

}  // namespace lmdbench
