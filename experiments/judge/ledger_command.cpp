// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <judge/judges.h>
#include <judge/ledger.h>

#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

/// lmdbench-judge ledger RESULT.h5... [--experiment FILE] [--out NAME]: the disagreement ledger of
/// cross-checked results. Markdown on standard output; --out adds NAME.md and NAME.json (all rows).
namespace lmdbench::exact {
namespace {

struct LedgerChoice {
  std::vector<std::string> results;
  std::string experiment, out;
};

int judge_ledger(const LedgerChoice& choice) {
  std::vector<Ledger> ledgers;
  std::string json;
  for (const std::string& result : choice.results) {
    const auto file =
        choice.experiment.empty() ? experiment_file_of(result) : std::filesystem::path(choice.experiment);
    ledgers.push_back(arbitrate(result, file));
    json += (json.empty() ? "[\n" : ",\n") + ledger_json(ledgers.back());
  }
  const std::string markdown = ledger_markdown(ledgers);
  std::cout << markdown;
  if (!choice.out.empty()) {
    std::ofstream(choice.out + ".md") << markdown;
    std::ofstream(choice.out + ".json") << json << "\n]\n";
  }
  return static_cast<int>(ExitCode::DONE);
}

}  // namespace

void add_ledger(CLI::App& app, Run& chosen) {
  CLI::App* command =
      app.add_subcommand("ledger", "Arbitrates what FCL, the nearest pair and the methods answered");
  const auto choice = std::make_shared<LedgerChoice>();
  command->add_option("results", choice->results, "result files of lmdbench run with an FCL cross-check")
      ->required();
  command->add_option("--experiment", choice->experiment,
                      "experiment file, if not found where the run's command line says");
  command->add_option("--out", choice->out, "also write NAME.md and NAME.json");
  command->callback([&chosen, choice] { chosen = [choice] { return judge_ledger(*choice); }; });
}

}  // namespace lmdbench::exact
