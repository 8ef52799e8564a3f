// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lmdbench {

/// The experiment file of a command and what `--set` changes of it.
struct ExperimentArgument {
  std::string file;
  std::vector<Override> overrides;

  /// Loads it with the methods of plugins beside its own, and tells what the overrides replaced beside their own values.
  /// @throws UsageError as `load_experiment`
  Experiment load() const;
};

/// Adds the positional argument, which it returns, and `--set`.
/// @param argument outlives the command
CLI::Option* add_experiment_argument(CLI::App& command, ExperimentArgument& argument,
                                     const std::string& description = "experiment file (JSON)");

}  // namespace lmdbench
