// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/metrics/method_summary.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/probes/truth_probe.h>

#include <cstdint>
#include <span>
#include <vector>

/// What truth in every frame lets a sweep say beyond the summary of a run (metrics/method_summary.h): events from
/// one frame to the next, counted, so that they have intervals, and torque.
namespace lmdbench {

/// A force below the first and one above the second share of F_max, one frame apart, is a switch between zero and
/// strong (claim K1).
inline constexpr double ZERO_SHARE = 0.05;
inline constexpr double STRONG_SHARE = 0.5;

/// NaN for what was not measured. Every frame and step counts that is in contact.
struct StepNumbers {
  double jumps = UNSET;  ///< Steps that change the force by more than JUMP_SHARE of F_max (errors.h); among
  double true_jumps = UNSET;  ///< the numbers of the summary, like the same of the true force.
#define NUMBER(name, ...) double name = UNSET;
#include <lmdbench/metrics/step_numbers.def>
#undef NUMBER
};

using StepNumber = Metric<StepNumbers>;

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
