// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/examples.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace lmdbench {
namespace {

constexpr std::array<CommandExamples, 18> EXAMPLES{{
    {"", {"lmdbench run experiments/shapes.json", "lmdbench report results/shapes.h5 --out results/shapes"}},
    {"run",
     {"lmdbench run experiments/shapes.json --verbose",
      "lmdbench run experiments/bunny-hard.json --out results/mine.h5 --set /driver/search_every_frames=50"}},
    {"plan",
     {"lmdbench plan experiments/bunny-hard.json",
      "lmdbench plan experiments/shapes.json --set /frames=60 --json"}},
    {"init",
     {"lmdbench init peg.stl hole.stl --out my",
      "lmdbench init peg.stl hole.stl --unit mm --contact --out my"}},
    {"query",
     {"lmdbench query --moving peg.stl --fixed hole.stl --cutoff 0.002 --method certified",
      "lmdbench query --moving blob --fixed torus --unit 0.05371,0.09468 --cutoff 0.002 --poses "
      "paths/shapes.tum --json"}},
    {"compare",
     {"lmdbench compare results/before.h5 results/after.h5",
      "lmdbench compare --base results/a1.h5 results/a2.h5 --candidate results/b1.h5 results/b2.h5 "
      "--markdown"}},
    {"doctor", {"lmdbench doctor", "lmdbench doctor --json"}},
    {"stability",
     {"lmdbench stability experiments/wall.json",
      "lmdbench stability experiments/wall.json --set /loop/delay_frames=5 --json"}},
    {"record",
     {"lmdbench record experiments/wall.json --out results/wall.tum",
      "lmdbench record experiments/wall.json --out results/wall.tum --every 10"}},
    {"report",
     {"lmdbench report results/shapes.h5 --out results/shapes",
      "lmdbench report results/bunny-hard.h5 results/bunny-soft.h5 --paper --out results/paper"}},
    {"work-precision",
     {"lmdbench work-precision experiments/sweeps/budget.json",
      "lmdbench work-precision experiments/sweeps/budget.json --list"}},
    {"anatomy",
     {"lmdbench anatomy experiments/bunny-soft.json",
      "lmdbench anatomy experiments/shapes.json --level 2 4"}},
    {"export",
     {"lmdbench export results/shapes.h5 --out results/paraview",
      "lmdbench export results/shapes.h5 --out results/paraview --frames 20"}},
    {"mesh list", {"lmdbench mesh list", "lmdbench mesh list --json"}},
    {"mesh build", {"lmdbench mesh build bunny-16k bunny-5k", "lmdbench mesh build"}},
    {"mesh info", {"lmdbench mesh info peg.stl", "lmdbench mesh info bunny-16k --json"}},
    {"path generate",
     {"lmdbench path generate paths/bunny-hard.json --out results/my.tum",
      "lmdbench path generate paths/bunny-soft.json --out results/my.tum --json"}},
    {"path info",
     {"lmdbench path info paths/shapes.tum", "lmdbench path info paths/shapes.tum --rate 1000 --json"}},
}};

CLI::App* find_command(CLI::App& app, std::string_view command) {
  if (command.empty()) return &app;
  const std::size_t space = command.find(' ');
  const auto found = app.get_subcommands(
      [&](const CLI::App* known) { return known->get_name() == command.substr(0, space); });
  if (found.empty() || space == std::string_view::npos) return found.empty() ? nullptr : found.front();
  return find_command(*found.front(), command.substr(space + 1));
}

}  // namespace

std::span<const CommandExamples> command_examples() {
  return EXAMPLES;
}

void add_examples(CLI::App& app) {
  for (const CommandExamples& examples : EXAMPLES)
    if (CLI::App* const command = find_command(app, examples.command))
      command->footer(fmt::format("{}\n\nExamples:\n  {}\n  {}", command->get_footer(), examples.calls[0],
                                  examples.calls[1]));
}

}  // namespace lmdbench
