// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/completeness/hostile_scenes.h>
#include <study/pieces.h>
#include <study/studies.h>
#include <support/context.h>
#include <support/program.h>

#include <algorithm>
#include <cstdio>
#include <memory>

/// lmdbench-study hostile [--poses N] [--frames N] [--seed S] [--motion M]... [--json FILE]:
/// `certified` against `exhaustive` on broken meshes, at unrelated poses and along difficult
/// motion. Markdown on standard output, errors on standard error. Exit code 1 where there is one.
namespace lmdbench::completeness {
namespace {

struct HostileChoice {
  std::size_t poses = 20000, frames = 100000;  ///< Frames of all motions together.
  std::uint64_t seed = 1;
  std::vector<std::string> motions;
  std::size_t complaints = 20;
  std::string json;
};

std::vector<Motion> motions_of(const HostileChoice& choice) {
  std::vector<Motion> motions;
  for (const Motion motion : ALL_MOTIONS)
    if (std::find(choice.motions.begin(), choice.motions.end(), name_of(motion)) != choice.motions.end())
      motions.push_back(motion);
  return motions;
}

int judge_all(const HostileChoice& choice) {
  std::size_t told = 0, searches = 0, wrong = 0, nearest_asked = 0;
  const Complain complain = [&](const std::string& what) {
    if (++told <= choice.complaints) fmt::print(stderr, "wrong: {}\n", what);
  };
  nlohmann::json report = {{"format", "lmdbench-hostile"},
                           {"format_version", 1},
                           {"context", experiments::run_context()},
                           {"seed", choice.seed},
                           {"motions", nlohmann::json::array()}};
  fmt::print("| motion | variant | searches | true LMDs | missed | wrong | duplicates | wrong poses |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  const auto moving_kinds = static_cast<std::size_t>(
      std::ranges::count_if(ALL_MOTIONS, [](Motion motion) { return !is_without_motion(motion); }));
  for (const Motion motion : motions_of(choice)) {
    const std::size_t poses =
        is_without_motion(motion) ? choice.poses : (choice.frames + moving_kinds - 1) / moving_kinds;
    const std::vector<Judgement> judgements = judge_hostile_scenes(motion, choice.seed, poses, complain);
    report["motions"].push_back({{"motion", name_of(motion)}, {"variants", variants_json(judgements)}});
    for (std::size_t v = 0; v < judgements.size(); ++v) {
      const Judgement& judgement = judgements[v];
      fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} |\n", name_of(motion), variants()[v].label,
                 judgement.poses, judgement.same.true_lmds, judgement.same.missed(), judgement.same.wrong(),
                 judgement.duplicates, judgement.wrong_poses);
      searches += judgement.poses;
      wrong += judgement.wrong_poses;
      nearest_asked += judgement.nearest_asked;
    }
    std::fflush(stdout);
    experiments::write_report(choice.json, report);
  }
  fmt::print("\n{} of {} searches are wrong; of {} the nearest pair had to be an LMD.\n", wrong, searches,
             nearest_asked);
  return static_cast<int>(wrong == 0 ? ExitCode::DONE : ExitCode::CHECK_FAILED);
}

}  // namespace
}  // namespace lmdbench::completeness

void lmdbench::study::add_hostile(CLI::App& app, Run& chosen) {
  using namespace completeness;
  CLI::App* command = app.add_subcommand("hostile", "Is certified right on broken meshes in nasty motion?");
  const auto choice = std::make_shared<HostileChoice>();
  std::vector<std::string> names;
  for (const Motion motion : ALL_MOTIONS) names.emplace_back(name_of(motion));
  command->add_option("--poses", choice->poses,
                      "Unrelated poses (motions 'none' and 'laid', each), 20 a pair of meshes");
  command->add_option("--frames", choice->frames,
                      "Frames of the other motions together, 100 a pair of meshes");
  command->add_option("--seed", choice->seed, "Of the random numbers");
  command->add_option("--motion", choice->motions, "May be repeated; all without it")
      ->check(CLI::IsMember(names));
  command->add_option("--complaints", choice->complaints, "Wrong searches that are told");
  command->add_option("--json", choice->json, "File that the table is written to as well");
  command->callback([&chosen, command, choice, names] {
    if (choice->motions.empty()) choice->motions = names;
    chosen.work = [choice] { return judge_all(*choice); };
    chosen.pieces = [command, choice] { return study::pieces_by(*command, {{"--motion", choice->motions}}); };
  });
}
