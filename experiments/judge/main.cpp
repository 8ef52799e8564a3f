// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <judge/judges.h>
#include <support/program.h>

/// lmdbench-judge: exact arithmetic decides who is right. It is a separate program, because CGAL's
/// kernels are (L)GPL and nothing else links them.
int main(int argc, char** argv) {
  using namespace lmdbench;
  CLI::App app("Judges answers in exact arithmetic", "lmdbench-judge");
  app.require_subcommand(1);
  exact::Run chosen;
  exact::add_truth(app, chosen);
  exact::add_generated(app, chosen);
  exact::add_ledger(app, chosen);
  exact::add_flat(app, chosen);
  exact::add_rest(app, chosen);
  exact::add_accuracy(app, chosen);
  experiments::refuse_nothing(app);
  return experiments::run_program(app, argc, argv, [&chosen] { return chosen(); });
}
