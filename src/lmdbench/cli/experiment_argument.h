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

/// A command's experiment file and its changes by `--set`.
struct ExperimentArgument {
  std::string file;
  std::vector<Override> overrides;

  /// Loads it with the plugins' methods, and reports values that overrides replaced indirectly.
  /// @throws UsageError as `load_experiment`
  Experiment load() const;
};

/// Adds the positional argument, which it returns, and `--set`.
/// @param argument must outlive the command
CLI::Option* add_experiment_argument(CLI::App& command, ExperimentArgument& argument,
                                     const std::string& description = "experiment file (JSON)");

}  // namespace lmdbench
