// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <judge/exact_scene_judgement.h>
#include <judge/judges.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// lmdbench-judge truth EXPERIMENT.json... [--frames N] [--out FILE.md]: judges the truth, and
/// `certified` with it, in exact arithmetic. A table on standard output, errors on standard error.
/// Exit code 1 where there is one.
namespace lmdbench::exact {
namespace {

struct TruthChoice {
  std::vector<std::string> experiments;
  std::int64_t frames = std::numeric_limits<std::int64_t>::max();
  std::string out;
};

int judge_truth(const TruthChoice& choice) {
  std::vector<Judgement> judgements;
  bool wrong = false;
  for (const std::string& experiment : choice.experiments) {
    for (Judgement& judgement : judge_experiment(experiment, choice.frames)) {
      for (const std::string& failure : judgement.failures) {
        std::cerr << judgement.scene << ": " << failure << '\n';
        wrong = true;
      }
      judgements.push_back(std::move(judgement));
    }
  }
  const std::string table = judgement_table(judgements, "experiment");
  std::cout << table;
  if (!choice.out.empty()) std::ofstream(choice.out) << "# Ground truth in exact arithmetic\n\n" << table;
  return static_cast<int>(wrong ? ExitCode::CHECK_FAILED : ExitCode::DONE);
}

}  // namespace

void add_truth(CLI::App& app, Run& chosen) {
  CLI::App* command =
      app.add_subcommand("truth", "Judges the ground truth of experiments by the definition of an LMD");
  const auto choice = std::make_shared<TruthChoice>();
  command->add_option("experiments", choice->experiments, "experiment files")->required();
  command->add_option("--frames", choice->frames,
                      "at most so many frames of each, evenly spread; all without it");
  command->add_option("--out", choice->out, "also write the table to this file");
  command->callback([&chosen, choice] { chosen = [choice] { return judge_truth(*choice); }; });
}

}  // namespace lmdbench::exact
