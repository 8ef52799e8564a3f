// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>
#include <lmdbench/view/export_frames.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <string>

namespace lmdbench {

void add_export_command(CLI::App& app) {
  struct Options {
    std::string result;
    std::string out;
    std::size_t frames = 100;
  };
  auto* command = app.add_subcommand(
      "export",
      "Write frames of a result for ParaView: meshes, LMDs, forces, polylines as VTU files over time");
  const auto options = std::make_shared<Options>();
  command->add_option("result", options->result, "result file of 'lmdbench run'")->required();
  command->add_option("--out,-o", options->out, "folder of the .pvd collections and their .vtu files")
      ->required();
  command
      ->add_option("--frames", options->frames,
                   "at most so many frames, evenly spread, of all devices together; about 0.8 MB each for "
                   "16,000 triangles")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command->callback([options] {
    for (const auto& file : export_frames(ResultReader(options->result), options->out, options->frames))
      fmt::print("{}\n", file.string());
  });
}

}  // namespace lmdbench
