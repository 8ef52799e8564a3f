// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

/// One function a subcommand: it adds the command and its options; the command's work runs as CLI11 callback
/// and throws the errors of `error.h`. Results go to standard output, everything else to standard error.
namespace lmdbench {

/// Those of this build; one that it was made without is there and says what it needs.
/// @param exit_status receives the exit code of a command that judges
void add_commands(CLI::App& app, const std::vector<std::string>& argv, int& exit_status);

void add_run_command(CLI::App& app, const std::vector<std::string>& argv);
void add_plan_command(CLI::App& app);
void add_init_command(CLI::App& app);
void add_query_command(CLI::App& app);
/// @param exit_status receives the exit code of the verdict
void add_compare_command(CLI::App& app, int& exit_status);
/// @param exit_status CHECK_FAILED where something is bad
void add_doctor_command(CLI::App& app, int& exit_status);
/// @param exit_status INPUT_DATA where a search found no stiffness
void add_stability_command(CLI::App& app, int& exit_status);
void add_record_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_work_precision_command(CLI::App& app, const std::vector<std::string>& argv);

}  // namespace lmdbench
