// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/result_file/node_watch.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <support/program.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <system_error>

namespace lmdbench::experiments {

void add_mesh_options(CLI::App& app, SceneChoice& scene) {
  app.add_option("--moving", scene.moving, "Moving mesh");
  app.add_option("--fixed", scene.fixed, "Fixed mesh");
}

void add_scene_options(CLI::App& app, SceneChoice& scene) {
  app.add_option("--meshes", scene.meshes, "Folder of built meshes");
  app.add_option("--diagonal", scene.diagonal, "Diagonal of both meshes [m]");
  app.add_option("--gap", scene.gap, "Gap, share of the diagonal");
}

void add_study_options(CLI::App& app, StudyChoice& choice) {
  add_scene_options(app, choice.scene);
  app.add_option("--cutoff", choice.cutoffs, "Cutoffs, shares of the diagonal");
  app.add_option("--poses", choice.poses, "How many poses");
  app.add_option("--seed", choice.seed, "Seed of the poses");
  app.add_option("--json", choice.json, "Also write the tables to this file");
}

int report_errors(const std::function<int()>& run) {
  try {
    return run();
  } catch (const Error& error) {
    std::cerr << "error: " << error.what() << '\n';
    return static_cast<int>(error.code());
  } catch (const std::system_error& error) {
    std::cerr << "error: the system refuses: " << error.what() << '\n';
    return static_cast<int>(ExitCode::ENVIRONMENT);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return static_cast<int>(ExitCode::INPUT_DATA);
  }
}

namespace {

/// Runs since the command line was read.
const NodeWatch& watch() {
  static const NodeWatch since_start(true);
  return since_start;
}

}  // namespace

bool& reports_name_node() {
  static bool name_node = false;
  return name_node;
}

void refuse_nothing(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options())
      // An empty text is read as 0.
      for (const char* count : {"--poses", "--frames", "--repetitions"})
        if (option->get_name() == count)
          option->check(CLI::Range(1, std::numeric_limits<int>::max(), "POSITIVE"));
}

int run_program(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run) {
  // Checks of a command while it is read throw our errors, too.
  return report_errors([&] {
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::USAGE);
    }
    if (reports_name_node()) watch();
    const int status = run();
    // A table that is cut off must not look like one; who flushed it left the error flag.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw EnvironmentError("", "standard output", "cannot be written",
                             "check the disk or the reader of the pipe");
    return status;
  });
}

void write_report(const std::string& file, const nlohmann::json& report) {
  if (file.empty()) return;
  nlohmann::json told = report;
  if (reports_name_node()) told["where"] = watch().finish();
  write_file_atomically(file, told.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

nlohmann::json error_json(const Agreement& same, const Agreement& neighbours) {
  return {{"true_lmds", same.true_lmds},
          {"found", same.found},
          {"found_adjacent", neighbours.found},
          {"reported", same.reported},
          {"right", same.right},
          {"right_adjacent", neighbours.right},
          {"recall", same.recall()},
          {"recall_adjacent", neighbours.recall()},
          {"precision", same.precision()},
          {"precision_adjacent", neighbours.precision()}};
}

}  // namespace lmdbench::experiments
