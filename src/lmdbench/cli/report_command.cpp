// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>
#include <lmdbench/view/report.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

namespace lmdbench {

void add_report_command(CLI::App& app) {
  auto* command = app.add_subcommand("report", "Make a page of results: one file that needs no network");
  const auto request = std::make_shared<ReportRequest>();
  command
      ->add_option("results", request->results,
                   "result files of 'lmdbench run' and 'lmdbench work-precision'")
      ->required();
  command->add_option("--out,-o", request->out, "folder of index.html and of its figures")->required();
  command->add_option("--study", request->studies,
                      "Markdown tables to show as well, such as results/reference/*.md");
  auto* paper =
      command
          ->add_option(
              "--paper", request->paper_figures,
              "hold the results against the paper: its Figure 7, its claims K1 to K12 and, of a folder, its "
              "Figures 1 to 6, as scripts/figures/figure1.py to figure6.py draw them")
          ->expected(0, 1)
          ->option_text("[FOLDER]");
  command->callback([request, paper] {
    request->paper = paper->count() > 0;
    const auto page = write_report(
        *request, [](const std::string& step) { spdlog::info("{}", step); },
        [](const std::string& problem) { spdlog::warn("{}", problem); });
    fmt::print("{}\n", page.string());
  });
}

}  // namespace lmdbench
