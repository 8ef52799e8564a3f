// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/output_guard.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/experiment_argument.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/run/record_path.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lmdbench {
namespace {

struct RecordOptions {
  ExperimentArgument experiment;
  std::string out;
  std::size_t every = 1;
};

/// Begins the first line of a recorded path.
constexpr std::string_view RECORDED_PATH_MARK = "true path of the simulated device of experiment";

bool is_recorded_path(const std::filesystem::path& file) {
  return file_begins_with(file, fmt::format("# {}", RECORDED_PATH_MARK));
}

void record(const RecordOptions& options) {
  const Experiment experiment = options.experiment.load();
  refuse_unsafe_output(options.out, {.what = "recorded path", .is_ours = &is_recorded_path},
                       input_files(experiment), "--out");
  ProgressBar bar(talk_welcome());
  const Path path = record_path(experiment, options.every, std::ref(bar));
  bar.wipe();
  write_tum(options.out, path,
            fmt::format("{} '{}', method '{}'", RECORDED_PATH_MARK, experiment.name,
                        experiment.methods.front().label));
  spdlog::info("wrote {} poses to {}", path.size(), options.out);
}

}  // namespace

void add_record_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("record", "Record the path that the simulated device takes in a closed loop");
  const auto options = std::make_shared<RecordOptions>();
  add_experiment_argument(*command, options->experiment, "experiment file (JSON) whose loop is closed")
      ->required();
  command->add_option("--out,-o", options->out, "path to write (TUM trajectory)")->required();
  command->add_option("--every", options->every, "keep every so many-th frame; all of them without it")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
  command->callback([options] { record(*options); });
}

}  // namespace lmdbench
