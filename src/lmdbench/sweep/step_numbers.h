// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/prepare.h>
#include <lmdbench/experiment/records.h>
#include <lmdbench/experiment/truth_probe.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

/// What truth in every frame lets a sweep say beyond the summary of a run (experiment/method_summary.h): events from
/// one frame to the next, counted, so that they have intervals, and torque.
namespace lmdbench {

/// A force below the first and one above the second share of F_max, one frame apart, is a switch between zero and
/// strong (claim K1).
inline constexpr double ZERO_SHARE = 0.05;
inline constexpr double STRONG_SHARE = 0.5;

/// NaN for what was not measured. Every frame and step counts that is in contact.
struct StepNumbers {
  double seconds_in_contact = UNSET;
  double jumps = UNSET;  ///< Steps that change the force by more than JUMP_SHARE of F_max (errors.h); among
  double true_jumps = UNSET;    ///< the numbers of the summary, like the same of the true force.
  double false_jumps = UNSET;   ///< Jumps of the method in steps without a true one.
  double missed_jumps = UNSET;  ///< True jumps in steps in which the method has none.
  double switches = UNSET;      ///< Between zero and strong.
  double true_switches = UNSET;
  double births = UNSET;  ///< LMDs without a neighbour in the frame before.
  double deaths = UNSET;  ///< LMDs without a neighbour in the frame after.
  double true_births = UNSET;
  double true_deaths = UNSET;
  double lmd_count_mean = UNSET;  ///< LMDs within the cutoff.
  double true_lmd_count_mean = UNSET;
  double force_mean_n = UNSET;       ///< Length of the rendered force.
  double true_force_mean_n = UNSET;  ///< The true one's under the same law.
  double force_magnitude_error_rms_n = UNSET;
  double force_angle_error_p99_rad = UNSET;
  double minimum_distance_error_p99_m = UNSET;
  double torque_error_rms_n_m = UNSET;
  double torque_error_maximum_n_m = UNSET;
  double frames_clipped = UNSET;
  double frames_empty = UNSET;  ///< In contact, and the method has no LMD.
  double candidates = UNSET;    ///< Of all searches.
  double kept = UNSET;          ///< After their first reductions.
};

/// A number of them with what a reader must know of it.
struct StepNumber {
  std::string_view name;
  std::string_view units;
  std::string_view long_name;
  double StepNumbers::*value;
};

/// All numbers, in the order of reports.
std::span<const StepNumber> step_numbers();

/// @param record     of a method on `run`, with the LMD set of every frame
/// @param truth      of every frame from the first that counts on, but the last
/// @param rows       the comparison of each truth frame
/// @param truth_run  whose meshes truth is of: features correspond where it is `run` itself
/// @param in_contact one a frame
StepNumbers count_steps(const MethodRecord& record, ForceLaw law, const std::vector<TruthFrame>& truth,
                        const std::vector<TruthComparison>& rows, const PreparedRun& run,
                        const PreparedRun& truth_run, const std::vector<bool>& in_contact);

}  // namespace lmdbench
