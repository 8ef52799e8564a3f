// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/completeness/laid_poses.h>
#include <study/completeness/metamorphic.h>
#include <study/pieces.h>
#include <study/studies.h>
#include <support/context.h>
#include <support/parts/parts_scenes.h>
#include <support/parts/rest_fits.h>
#include <support/program.h>
#include <support/scene_files.h>

#include <algorithm>
#include <cstdio>
#include <memory>

/// lmdbench-study metamorphic [--poses N] [--seed S] [--parts NAME]... [--generator G] [--out DIR]
/// [--json FILE]: changes that must not change the answer. Markdown on standard output, errors on
/// standard error, the first wrong pair as files. Exit code 1 where there is one.
namespace lmdbench::completeness {
namespace {

struct MetamorphicChoice {
  std::size_t poses = 20;
  std::uint64_t seed = 1;
  std::string generator = "rest";
  std::vector<std::string> parts, changes;
  std::size_t complaints = 5;
  std::string out, json;
};

std::vector<std::string> names_of(const std::string& generator) {
  std::vector<std::string> names;
  if (generator == "rest")
    for (const parts::RestFit& fit : parts::rest_fits()) names.emplace_back(fit.name);
  for (const auto& [name, kinds] : parts::HARD_GENERATORS)
    if (generator == name || generator == "laid")
      for (const parts::PartsKind& kind : parts::parts_kinds(kinds)) names.emplace_back(kind.name);
  return names;
}

/// @param index of the pose; poses of one parts scene have consecutive indices
ScenePair make_pair(const MetamorphicChoice& choice, const std::string& name, std::size_t index) {
  if (choice.generator == "rest")
    return pair_of(parts::make_rest_scene(parts::rest_fit(name), choice.seed, index));
  const parts::Coordinates coordinates = parts::ALL_COORDINATES[index % std::size(parts::ALL_COORDINATES)];
  const parts::PartsScene scene =
      parts::make_parts_scene({name, coordinates, choice.seed, index, parts::PoseFamily::ANY});
  ScenePair pair = pair_of(scene.scene, scene.poses[index % scene.poses.size()]);
  if (choice.generator == "laid") {
    experiments::Random random(choice.seed * 0x9E3779B97F4A7C15ULL + index);
    pair.X_WM = laid_pose(pair.moving, pair.fixed, random);
  }
  return pair;
}

int judge_all(const MetamorphicChoice& choice) {
  std::vector<const Change*> chosen;
  for (const Change& change : metamorphic_changes())
    if (choice.changes.empty() || std::ranges::count(choice.changes, change.name) != 0)
      chosen.push_back(&change);
  std::vector<MetamorphicCounts> counts(chosen.size());
  std::size_t told = 0, wrong_pairs = 0;
  for (std::size_t n = 0; n < choice.parts.size(); ++n) {
    for (std::size_t index = 0; index < choice.poses; ++index) {
      const ScenePair pair = make_pair(choice, choice.parts[n], index);
      const LmdSet truth = set_of("exhaustive", pair);
      experiments::Random random((choice.seed * 1000 + n) * 0x9E3779B97F4A7C15ULL + index);
      std::string objection;
      for (std::size_t c = 0; c < chosen.size(); ++c)
        counts[c] += judge_change(pair, truth, *chosen[c], random, objection);
      if (objection.empty()) continue;
      if (++wrong_pairs == 1 && !choice.out.empty())
        fmt::print(stderr, "The first pair at fault:\n  {}\n",
                   experiments::write_scene(scene_of(pair), pair.X_WM, "exhaustive", choice.out));
      if (++told <= choice.complaints)
        fmt::print(stderr, "{}, seed {}, pose {}:\n{}", choice.parts[n], choice.seed, index, objection);
    }
  }
  nlohmann::json report = {{"format", "lmdbench-metamorphic"},      {"format_version", 1},
                           {"context", experiments::run_context()}, {"seed", choice.seed},
                           {"generator", choice.generator},         {"changes", nlohmann::json::array()}};
  fmt::print(
      "| change | pairs | different | other bits | ties | certified differs |\n|---|---|---|---|---|---|\n");
  bool wrong = false;
  std::size_t changed = 0, ties = 0;
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const MetamorphicCounts& count = counts[c];
    fmt::print("| {} | {} | {} | {}{} | {} | {} |\n", chosen[c]->name, count.pairs, count.different,
               count.bits_different, chosen[c]->keeps_bits ? "" : " (expected)", count.ties,
               count.incomplete);
    wrong = wrong || count.is_wrong(*chosen[c]);
    changed += count.pairs;
    ties += count.ties;
    report["changes"].push_back({{"name", chosen[c]->name},
                                 {"pairs", count.pairs},
                                 {"different", count.different},
                                 {"bits_different", count.bits_different},
                                 {"ties", count.ties},
                                 {"certified_different", count.incomplete}});
  }
  experiments::write_report(choice.json, report);
  fmt::print("\n{} of {} pairs are answered otherwise after some change; {} of {} changes are ties.\n",
             wrong_pairs, choice.poses * choice.parts.size(), ties, changed);
  return static_cast<int>(wrong ? ExitCode::CHECK_FAILED : ExitCode::DONE);
}

}  // namespace
}  // namespace lmdbench::completeness

void lmdbench::study::add_metamorphic(CLI::App& app, Run& chosen) {
  using namespace completeness;
  CLI::App* command = app.add_subcommand(
      "metamorphic", "Does the answer stay when meshes are swapped, turned, scaled, cut otherwise?");
  const auto choice = std::make_shared<MetamorphicChoice>();
  std::vector<std::string> generators = {"rest", "laid"}, names;
  for (const auto& [name, generator] : parts::HARD_GENERATORS) generators.push_back(name);
  for (const Change& change : metamorphic_changes()) names.emplace_back(change.name);
  command->add_option("--poses", choice->poses, "Of each kind of parts");
  command->add_option("--seed", choice->seed, "Of the random numbers");
  command
      ->add_option(
          "--generator", choice->generator,
          "rest (fits with gaps of 0 to what is seen), parts, solids or shapes (as of `parts`), laid "
          "(all of these corner on corner, edge on edge)")
      ->check(CLI::IsMember(generators));
  command->add_option("--parts", choice->parts,
                      "A fit or kind of the generator, may be repeated; all without it");
  command->add_option("--change", choice->changes, "May be repeated; all without it")
      ->check(CLI::IsMember(names));
  command->add_option("--complaints", choice->complaints, "Pairs at fault that are told");
  command->add_option("--out", choice->out, "Folder for the meshes and the pose of the first pair at fault");
  command->add_option("--json", choice->json, "File that the table is written to as well");
  command->callback([&chosen, command, choice] {
    const std::vector<std::string> all = names_of(choice->generator);
    for (const std::string& name : choice->parts)
      if (std::ranges::count(all, name) == 0)
        throw CLI::ValidationError("--parts", "no '" + name + "' there");
    if (choice->parts.empty()) choice->parts = all;
    chosen.work = [choice] { return judge_all(*choice); };
    chosen.pieces = [command, choice] { return study::pieces_by(*command, {{"--parts", choice->parts}}); };
  });
}
