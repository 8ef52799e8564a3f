// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include "oracle/ledger.h"
#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>
#include <string>
#include <vector>

/// lmdbench_ledger RESULT.h5... [--experiment FILE] [--out NAME]: the disagreement ledger of results with an
/// FCL cross-check; Markdown on standard output, with --out also NAME.md and, with all rows, NAME.json.
int main(int argc, char** argv) {
  CLI::App app{"Arbitrates what FCL, the nearest pair and the methods answered, in exact arithmetic"};
  std::vector<std::string> results;
  std::string experiment, out;
  app.add_option("results", results, "result files of lmdbench run with an FCL cross-check")->required();
  app.add_option("--experiment", experiment,
                 "experiment file, if not found where the run's command line says");
  app.add_option("--out", out, "also write NAME.md and NAME.json");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<lmdbench::exact::Ledger> ledgers;
    std::string json;
    for (const std::string& result : results) {
      const auto file = experiment.empty() ? lmdbench::exact::experiment_file_of(result)
                                           : std::filesystem::path(experiment);
      ledgers.push_back(lmdbench::exact::arbitrate(result, file));
      json += (json.empty() ? "[\n" : ",\n") + lmdbench::exact::ledger_json(ledgers.back());
    }
    const std::string markdown = lmdbench::exact::ledger_markdown(ledgers);
    std::cout << markdown;
    if (!out.empty()) {
      std::ofstream(out + ".md") << markdown;
      std::ofstream(out + ".json") << json << "\n]\n";
    }
  } catch (const lmdbench::Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(lmdbench::ExitCode::INPUT_DATA);
  }
}
