// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <judge/exact_scene_judgement.h>
#include <judge/generated_poses.h>
#include <judge/judges.h>
#include <support/scene_files.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

/// lmdbench-judge generated [--generator NAME]... [--poses N] [--seed S] [--out DIR]: judges
/// `exhaustive` and `certified` by exact arithmetic, as `truth` does, on generated parts a little
/// off the poses that are drawn. Table and errors are printed. Exit code 1 where there is one.
namespace lmdbench::exact {
namespace {

struct GeneratedChoice {
  std::size_t poses = 1000;
  std::uint64_t seed = 1;
  std::vector<std::string> generators;
  std::size_t complaints = 20;
  std::string out;
};

int judge_generated(const GeneratedChoice& choice) {
  std::size_t told = 0, judged = 0, wrong = 0;
  std::vector<Judgement> judgements;
  for (const std::string& generator : choice.generators) {
    const std::vector<std::string> kinds = generated_kinds(generator);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      std::vector<Judgement> rows = empty_judgements(fmt::format("{}: {}", generator, kinds[k]));
      const std::size_t poses = choice.poses / kinds.size() + (k < choice.poses % kinds.size());
      for (std::size_t index = 0; index < poses; ++index) {
        const GeneratedPose pose = make_generated_pose(generator, kinds[k], choice.seed, index);
        ++judged;
        if (!judge_pose(pose.scene, pose.X_WM, judged_methods(pose.scene), pose.text, rows)) continue;
        if (++wrong == 1 && !choice.out.empty())
          fmt::print(stderr, "The first scene at fault:\n  {}\n",
                     experiments::write_scene(pose.scene, pose.X_WM, "exhaustive", choice.out));
        for (Judgement& row : rows) {
          for (const std::string& failure : row.failures)
            if (++told <= choice.complaints) fmt::print(stderr, "{}: {}\n", row.scene, failure);
          row.failures.clear();
        }
      }
      judgements.insert(judgements.end(), rows.begin(), rows.end());
    }
  }
  fmt::print("{}\n{} of {} poses are wrong\n", judgement_table(judgements, "kind"), wrong, judged);
  return static_cast<int>(wrong > 0 ? ExitCode::CHECK_FAILED : ExitCode::DONE);
}

}  // namespace

void add_generated(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand(
      "generated", "Judges generated parts in general position by the definition of an LMD");
  const auto choice = std::make_shared<GeneratedChoice>();
  command->add_option("--generator", choice->generators, "parts, rest, shapes or solids; all without it")
      ->check(CLI::IsMember(generators()));
  command->add_option("--poses", choice->poses, "Of each generator, each of parts of its own")
      ->capture_default_str();
  command->add_option("--seed", choice->seed, "Of the random numbers")->capture_default_str();
  command->add_option("--complaints", choice->complaints, "Errors that are told")->capture_default_str();
  command->add_option("--out", choice->out, "Folder for the meshes and the pose of the first scene at fault");
  command->callback([&chosen, choice] {
    if (choice->generators.empty()) choice->generators = generators();
    chosen = [choice] { return judge_generated(*choice); };
  });
}

}  // namespace lmdbench::exact
