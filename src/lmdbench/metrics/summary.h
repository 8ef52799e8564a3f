// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/metrics/method_summary.h>
#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/run/run.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lmdbench {

/// A method under a later profile, compared with itself under the first one.
struct ProfileDifference {
  std::size_t method = 0;  ///< Index in the summary's methods.
  std::size_t first = 0;   ///< The same method under the first profile.
  /// Length of the difference of the two rendered forces at the same poses, over frames with
  /// contact of either; NaN in a closed loop, where the poses differ.
  double force_difference_rms_n = UNSET;
  double force_difference_maximum_n = UNSET;
};

/// A method that promises the complete set, and frames in which FCL disproves it.
struct NearestError {
  std::string label;
  std::int64_t frames = 0;
  FclException first;

  /// For people: the first frame and its distances by all.
  std::string text() const;
};

/// The numbers of a run. Times exclude the warm-up and are never shown without errors.
struct RunSummary {
  std::string name;
  bool closed_loop = false;
  std::int64_t frames = 0;
  /// Of the path; in a closed loop the hand's. Each method has the number of its device.
  std::int64_t frames_in_contact = 0;
  std::int64_t frames_probed = 0;  ///< 0: no truth, errors are not measured.
  std::int64_t measured_repetitions = 0;
  double frame_rate_hz = UNSET;
  double cutoff_m = UNSET;
  /// Label of the method that gives the truth of every frame (CompleteTruth), in a closed loop for
  /// the first method's device; empty where truth is known in the probed frames alone.
  std::string truth_of_every_frame;
  double true_lmd_count_median = UNSET;   ///< Over the frames in contact whose truth is known.
  double true_lmd_count_maximum = UNSET;  ///< Over the frames whose truth is known.
  std::vector<MethodSummary> methods;
  std::vector<ProfileDifference> profiles;  ///< Empty with one profile.
  std::int64_t fcl_frames = 0;              ///< Cross-checked frames; 0: not asked for.
  std::int64_t fcl_separated = 0;
  std::int64_t fcl_agreeing = 0;                       ///< Separated or not.
  std::map<std::string, std::int64_t> fcl_exceptions;  ///< By label of the one out of tolerance.
  std::vector<NearestError> nearest_errors;            ///< One for each wrong method.
  double fcl_tolerance_relative = UNSET;
  std::vector<std::string> warnings;
  std::vector<std::string> broken_limits;  ///< Of the experiment's "limits".
  std::vector<DefaultNote> defaults;       ///< Values that the file leaves open.
};

RunSummary summarise(const Experiment& experiment, const RunResult& result);

/// For people: a line a method (errors beside times, over the frames in contact), and the verdicts.
std::string summary_table(const RunSummary& summary);

/// All numbers for people, and the verdicts; several profiles are compared method by method.
std::string summary_text(const RunSummary& summary);

/// Notes, wrong nearest distances and broken limits, one line each.
std::string summary_verdicts(const RunSummary& summary);

/// JSON text with the same numbers named as in `summary_numbers`, null for NaN; also "profiles":
/// [{"method", "profile", "against", "force_difference_rms_n", "force_difference_maximum_n",
/// "differences": {NUMBER: value - value under the first profile}}].
std::string summary_json(const RunSummary& summary);

/// `/summary` and `/methods/LABEL/summary` of the result file: a dataset of one value a number.
void write_summary(ResultWriter& writer, const RunSummary& summary);

}  // namespace lmdbench
