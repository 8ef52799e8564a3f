// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <study/pieces.h>
#include <study/studies.h>
#include <support/program.h>

/// lmdbench-study: questions beyond one experiment. Markdown on standard output, numbers in the
/// file of --json; exit code 1 when a method breaks a promise.
int main(int argc, char** argv) {
  using namespace lmdbench;
  CLI::App app("Studies of the methods: what they miss, what they cost, how costs grow", "lmdbench-study");
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();  // for help
  study::Run chosen;
  bool pieces = false;
  app.add_flag("--pieces", pieces,
               "only print the calls that do the same piece by piece: a JSON array of argument lists "
               "(scripts/cluster/)");
  app.add_flag("--name-node", experiments::reports_name_node(),
               "reports say on which node they were made and beside what (scripts/cluster/)");
  study::add_recall(app, chosen);
  study::add_completeness(app, chosen);
  study::add_continuous_force(app, chosen);
  study::add_scaling(app, chosen);
  study::add_compare(app, chosen);
  study::add_deform(app, chosen);
  study::add_depth(app, chosen);
  study::add_flat(app, chosen);
  study::add_hostile(app, chosen);
  study::add_stability(app, chosen);
  study::add_passivity(app, chosen);
  study::add_leave_out(app, chosen);
  study::add_metamorphic(app, chosen);
  study::add_parts(app, chosen);
  study::add_roles(app, chosen);
  study::add_worlds(app, chosen);
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options())
      if (option->get_default_str() == "[]") option->default_str("");  // An empty list is none.
  experiments::refuse_nothing(app);
  return experiments::run_program(app, argc, argv, [&] {
    if (!pieces) return chosen.work();
    fmt::print("{}\n", study::pieces_json(app, chosen));
    return 0;
  });
}
