// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/fcl_probe.h>
#include <lmdbench/experiment/lockstep.h>
#include <lmdbench/experiment/plan.h>
#include <lmdbench/experiment/prepare.h>
#include <lmdbench/experiment/records.h>
#include <lmdbench/experiment/truth_probe.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// Everything that a run produced, in memory.
struct RunResult {
  Plan plan;
  PreparedRun prepared;
  std::vector<bool> in_contact;       ///< One a frame of the path (contact.h).
  std::vector<MethodRecord> records;  ///< In the order of the experiment's methods, like the next but one.
  std::vector<TruthFrame> truth;      ///< Empty where the plan leaves the probe out, and in a closed loop.
  /// Closed loop: truth at the poses that each method's device took, one list a method.
  std::vector<std::vector<TruthFrame>> truth_of_device;
  std::vector<std::vector<bool>>
      in_contact_of_device;  ///< Closed loop: one list a method, one entry a frame.
  std::vector<std::vector<TruthComparison>> comparisons;  ///< One list a method, one entry a TruthFrame.
  std::optional<FclCheck> fcl;
  std::vector<std::string> warnings;  ///< What a reader of the result must know, in plain words.

  /// Truth that a method was compared with; empty where the plan leaves the probe out.
  const std::vector<TruthFrame>& truth_of(std::size_t method) const {
    return truth_of_device.empty() ? truth : truth_of_device[method];
  }
  /// Frames in which the meshes are in contact at the method's poses.
  const std::vector<bool>& in_contact_of(std::size_t method) const {
    return in_contact_of_device.empty() ? in_contact : in_contact_of_device[method];
  }
};

/// What a run reports while it goes on: the phase ("run", "truth", "fcl"), what is done and what there is to
/// do. False stops the run after the current block.
using RunProgress = std::function<bool(const std::string& phase, std::int64_t done, std::int64_t total)>;

/// Runs an experiment in memory.
/// @throws Interrupted when `progress` returned false
RunResult run_experiment(const Experiment& experiment, const RunProgress& progress = {});

/// Runs it and leaves a result file, which takes its name only when it is complete: an earlier file of that
/// name stays whole until then. A file that cannot be written is noticed before the run, not after it.
RunResult run_experiment_to_file(const Experiment& experiment, const std::filesystem::path& file,
                                 const std::vector<std::string>& argv, const RunProgress& progress = {});

}  // namespace lmdbench
