// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// Each subcommand of lmdbench-study has one file.
namespace lmdbench::study {

/// The work of the chosen subcommand, after the command line is read.
struct Run {
  std::function<int()> work;  ///< Returns the exit code.
  /// Command lines that do the same work to the bit, if the study has pieces (pieces.h).
  std::function<std::vector<std::vector<std::string>>()> pieces;
};

/// Each adds its subcommand to `app`; naming it sets `chosen`, which must outlive the parsing.
void add_recall(CLI::App& app, Run& chosen);
void add_completeness(CLI::App& app, Run& chosen);
void add_continuous_force(CLI::App& app, Run& chosen);
void add_scaling(CLI::App& app, Run& chosen);
void add_compare(CLI::App& app, Run& chosen);
void add_deform(CLI::App& app, Run& chosen);
void add_depth(CLI::App& app, Run& chosen);
void add_flat(CLI::App& app, Run& chosen);
void add_hostile(CLI::App& app, Run& chosen);
void add_stability(CLI::App& app, Run& chosen);
void add_passivity(CLI::App& app, Run& chosen);
void add_leave_out(CLI::App& app, Run& chosen);
void add_metamorphic(CLI::App& app, Run& chosen);
void add_parts(CLI::App& app, Run& chosen);
void add_roles(CLI::App& app, Run& chosen);
void add_worlds(CLI::App& app, Run& chosen);

}  // namespace lmdbench::study
