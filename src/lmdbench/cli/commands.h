// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

/// One function a subcommand: it adds the command and its options. The work runs as a CLI11
/// callback and throws the errors of `error.h`. Standard output has results alone.
namespace lmdbench {

/// The commands of this build. A command without its library exists and names what it needs.
/// @param exit_status receives the exit code of a command with a verdict
void add_commands(CLI::App& app, const std::vector<std::string>& argv, int& exit_status);

void add_run_command(CLI::App& app, const std::vector<std::string>& argv);
void add_plan_command(CLI::App& app);
void add_init_command(CLI::App& app);
/// @param exit_status CHECK_FAILED where a plugin left a pose without an answer
void add_query_command(CLI::App& app, int& exit_status);
/// @param exit_status receives the exit code of the verdict
void add_compare_command(CLI::App& app, int& exit_status);
/// @param exit_status CHECK_FAILED where a check finds a fault
void add_doctor_command(CLI::App& app, int& exit_status);
/// @param exit_status INPUT_DATA where a search found no stiffness
void add_stability_command(CLI::App& app, int& exit_status);
void add_record_command(CLI::App& app);
void add_report_command(CLI::App& app);
/// @param exit_status CHECK_FAILED where points have no numbers
void add_work_precision_command(CLI::App& app, const std::vector<std::string>& argv, int& exit_status);
void add_anatomy_command(CLI::App& app);
void add_export_command(CLI::App& app);
/// `lmdbench mesh info MESH... [--json]` and `lmdbench mesh build [NAME...] [--json]`.
void add_mesh_command(CLI::App& app);
/// `--dir` of a command that takes names of the manifest.
/// @param folder is `default_mesh_folder` where the option is not given
void add_mesh_folder_option(CLI::App& command, std::string& folder);
/// `lmdbench plugin new FOLDER [--language c|c++|python]`, `lmdbench plugin check FILE [--json]`.
/// @param exit_status CHECK_FAILED where a plugin fails
void add_plugin_command(CLI::App& app, int& exit_status);
/// `lmdbench path generate SPEC.json --out FILE.tum [--json]` and
/// `lmdbench path info FILE.tum [--spec SPEC.json] [--rate HZ] [--json]`.
void add_path_command(CLI::App& app);

/// Sets up messages other than results: spdlog on standard error.
/// @param verbosity 0: information, negative: errors only, positive: details. Colours are used on
/// terminals only, and never where NO_COLOR is set (no-color.org).
void set_up_talk(int verbosity);

/// Whether to show progress bars and notes about written files: not when quiet. Requested answers
/// (of query, compare, plan, --json) are always printed.
bool talk_welcome();

/// For commands that clean up first: from now on the first SIGINT, SIGTERM or SIGHUP (from users,
/// terminals, schedulers) is only remembered; a second one ends the program at once. Signals that
/// `nohup` has set to be ignored stay ignored.
void heed_stop_signals();

/// Whether such a signal came.
bool stop_requested();

/// Ends the program by that signal, so that a calling shell or script sees the interruption, too.
void end_by_the_signal();

}  // namespace lmdbench
