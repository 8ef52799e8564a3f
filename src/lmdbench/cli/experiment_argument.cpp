// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/experiment_argument.h>
#include <lmdbench/methods/registry.h>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

namespace lmdbench {

Experiment ExperimentArgument::load() const {
  std::vector<std::string> from_outside;
  for (const MethodDescription& method : method_descriptions())
    if (!method.plugin.empty()) from_outside.push_back(method.name);
  Experiment experiment = load_experiment(file, overrides, from_outside);
  for (const std::string& note : experiment.notes) spdlog::info("{}", note);
  return experiment;
}

CLI::Option* add_experiment_argument(CLI::App& command, ExperimentArgument& argument,
                                     const std::string& description) {
  CLI::Option* file = command.add_option("experiment", argument.file, description);
  command
      .add_option("--set", argument.overrides,
                  "override a value: /json/pointer=value; repeatable. What excludes it goes")
      ->allow_extra_args(false);
  return file;
}

}  // namespace lmdbench
