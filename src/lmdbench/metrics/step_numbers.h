// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/metrics/method_summary.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/probes/truth_probe.h>

#include <span>
#include <vector>

/// Numbers of a sweep beyond a run's summary (metrics/method_summary.h) for truth in every frame:
/// counted events between frames, with intervals, and torque.
namespace lmdbench {

/// A switch between zero and strong (claim K1): a force below the first share of F_max one frame
/// apart from a force above the second.
inline constexpr double ZERO_SHARE = 0.05;
inline constexpr double STRONG_SHARE = 0.5;

/// NaN for unmeasured numbers. Over the frames in contact and the steps from and to one. Where
/// triangles intersect no force is the true one: such frames and steps count in no comparison.
struct StepNumbers {
  double jumps = UNSET;       ///< Steps with a force change over JUMP_SHARE of F_max (errors.h).
  double true_jumps = UNSET;  ///< The same of the true force. Both are in the summary.
#define NUMBER(name, ...) double name = UNSET;
#include <lmdbench/metrics/step_numbers.def>
#undef NUMBER
};

using StepNumber = Metric<StepNumbers>;

/// All numbers, in the order of reports.
std::span<const StepNumber> step_numbers();

/// @param record     of a method on `run`, with the LMD set of every frame
/// @param truth      of every frame but the last, from the first that counts
/// @param rows       the comparison of each truth frame
/// @param truth_run  has truth's meshes: features correspond where it is `run` itself
/// @param in_contact one a frame
StepNumbers count_steps(const MethodRecord& record, ForceLaw law, const std::vector<TruthFrame>& truth,
                        const std::vector<TruthComparison>& rows, const PreparedRun& run,
                        const PreparedRun& truth_run, const std::vector<bool>& in_contact);

}  // namespace lmdbench
