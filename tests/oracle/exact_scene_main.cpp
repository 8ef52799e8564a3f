// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include "oracle/exact_scene_judgement.h"
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

/// lmdbench_exact_truth EXPERIMENT.json... [--frames N] [--out FILE.md]: judges the ground truth, and
/// `certified` with it, in exact arithmetic; a table on standard output, what is wrong on standard error.
/// Exit code 1 where something is.
int main(int argc, char** argv) {
  CLI::App app{"Judges the ground truth of experiments by the definition of an LMD in exact arithmetic"};
  std::vector<std::string> experiments;
  std::int64_t frames = std::numeric_limits<std::int64_t>::max();
  std::string out;
  app.add_option("experiments", experiments, "experiment files")->required();
  app.add_option("--frames", frames, "at most so many frames of each, evenly spread; all without it");
  app.add_option("--out", out, "also write the table to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<lmdbench::exact::Judgement> judgements;
    bool wrong = false;
    for (const std::string& experiment : experiments) {
      for (auto& judgement : lmdbench::exact::judge_experiment(experiment, frames)) {
        for (const std::string& failure : judgement.failures) {
          std::cerr << judgement.experiment << ": " << failure << "\n";
          wrong = true;
        }
        judgements.push_back(std::move(judgement));
      }
    }
    const std::string table = lmdbench::exact::judgement_table(judgements);
    std::cout << table;
    if (!out.empty()) std::ofstream(out) << "# Ground truth in exact arithmetic\n\n" << table;
    return wrong ? static_cast<int>(lmdbench::ExitCode::CHECK_FAILED) : 0;
  } catch (const lmdbench::Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(lmdbench::ExitCode::INPUT_DATA);
  }
}
