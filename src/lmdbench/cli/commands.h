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
void add_anatomy_command(CLI::App& app);
void add_export_command(CLI::App& app);
/// `lmdbench mesh info MESH... [--json]` and `lmdbench mesh build [NAME...] [--json]`.
void add_mesh_command(CLI::App& app);
/// `--dir` of a command that takes names of the manifest.
/// @param folder is `default_mesh_folder` where the option is not given
void add_mesh_folder_option(CLI::App& command, std::string& folder);
/// `lmdbench plugin new FOLDER [--language c|c++|python]` and `lmdbench plugin check FILE.so [--json]`.
/// @param exit_status CHECK_FAILED where a plugin fails
void add_plugin_command(CLI::App& app, int& exit_status);
/// `lmdbench path generate SPEC.json --out FILE.tum [--json]` and
/// `lmdbench path info FILE.tum [--spec SPEC.json] [--rate HZ] [--json]`.
void add_path_command(CLI::App& app);

/// What the program says beside its results: spdlog on standard error.
/// @param verbosity 0 is normal (information), negative is quiet (errors only from -1 on), positive tells
/// details. Colours are used on terminals only, and never where NO_COLOR is set (no-color.org).
void set_up_talk(int verbosity);

/// Whether progress bars and what a command tells of the file that it has written are welcome: not when quiet. Answers
/// that were asked for (of query, compare, plan, --json) are printed all the same.
bool talk_welcome();

/// For commands that put their work into order first: from now on the first of the signals that users, terminals and
/// schedulers send to end a program (SIGINT, SIGTERM and SIGHUP) is only remembered; a second one ends the program at once. What `nohup`
/// has set to be ignored stays ignored.
void heed_stop_signals();

/// Whether one has come.
bool stop_requested();

/// Ends the program by the signal that came, so that a calling shell or script sees the interruption, too.
void end_by_the_signal();

}  // namespace lmdbench
