// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>

namespace lmdbench {

void add_commands(CLI::App& app, const std::vector<std::string>& argv, int& exit_status) {
  add_run_command(app, argv);
  add_plan_command(app);
  add_init_command(app);
  add_stability_command(app, exit_status);
  add_record_command(app);
  add_query_command(app, exit_status);
  add_compare_command(app, exit_status);
  add_doctor_command(app, exit_status);
  add_report_command(app);
  add_export_command(app);
  add_anatomy_command(app);
  add_work_precision_command(app, argv, exit_status);
  add_mesh_command(app);
  add_path_command(app);
  add_plugin_command(app, exit_status);
}

}  // namespace lmdbench
