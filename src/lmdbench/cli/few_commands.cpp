// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// In place of all_commands.cpp in a build without HDF5 (LMDBENCH_WITH_HDF5).
#include <lmdbench/base/build_info.h>
#include <lmdbench/cli/commands.h>

#include <CLI/CLI.hpp>

namespace lmdbench {

void add_commands(CLI::App& app, const std::vector<std::string>& /*argv*/, int& exit_status) {
  add_query_command(app, exit_status);
  add_mesh_command(app);
  add_path_command(app);
  add_plugin_command(app, exit_status);
  for (const std::string name : {"run", "plan", "init", "stability", "record", "compare", "doctor", "report",
                                 "export", "anatomy", "work-precision"}) {
    CLI::App* command = app.add_subcommand(name, "not in this build: needs HDF5");
    command->prefix_command()->fallthrough(false);  // takes any arguments
    command->callback([name] { throw missing_part(PART_HDF5, "", "", "the command " + name); });
  }
}

}  // namespace lmdbench
