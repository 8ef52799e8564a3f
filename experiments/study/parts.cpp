// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/completeness/parts_study.h>
#include <study/pieces.h>
#include <study/studies.h>
#include <support/context.h>
#include <support/program.h>

#include <cstdio>
#include <memory>

/// lmdbench-study parts [--poses N] [--seed S] [--kind K]... [--generator G] [--json FILE]:
/// `certified` against `exhaustive`. Markdown on standard output, wrong poses on standard error as
/// lines for completeness/tests/parts_study_test.cpp. Exit code 1 if there is one.
namespace lmdbench::completeness {
namespace {

struct PartsChoiceOfUser {
  PartsStudy study;
  std::size_t complaints = 20;
  std::string json;
};

nlohmann::json to_json(const PartsResult& result) {
  return {{"kind", result.kind},
          {"coordinates", name_of(result.coordinates)},
          {"poses", result.poses},
          {"true_lmds", result.true_lmds},
          {"wrong_poses", result.wrong_poses},
          {"poses_that_show_cut", result.poses_that_show_cut},
          {"of_these_at_a_border", result.of_these_at_a_border},
          {"poses_beside_an_intersection", result.poses_beside},
          {"variants", variants_json(result.judgements)}};
}

void print_row(const PartsResult& result) {
  const Judgement all = sum_of(result.judgements);
  const auto of_recut = [&](std::size_t count) {
    return result.coordinates == parts::Coordinates::RECUT ? fmt::format("{}", count) : "";
  };
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {:.1e} | {:.1e} | {} | {} |\n", result.kind,
             name_of(result.coordinates), result.poses, result.true_lmds, result.wrong_poses,
             all.same.missed(), all.same.wrong(), all.duplicates, all.worst_distance_difference,
             all.worst_point_difference, of_recut(result.poses_that_show_cut),
             of_recut(result.of_these_at_a_border));
  std::fflush(stdout);
}

int judge_all(const PartsChoiceOfUser& choice) {
  std::size_t told = 0, poses = 0, wrong = 0, nearest = 0, recut = 0, show_cut = 0, at_border = 0, beside = 0;
  const Complain complain = [&](const std::string& what) {
    if (++told <= choice.complaints) fmt::print(stderr, "{}\n", what);
  };
  fmt::print(
      "| kind | coordinates | poses | true LMDs | wrong poses | missed | wrong | duplicates | distance off, "
      "diagonals "
      "| points off, diagonals | the cut shows | of these at a border of the tolerance "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  nlohmann::json report = {{"format", "lmdbench-parts"},
                           {"format_version", 1},
                           {"context", experiments::run_context()},
                           {"seed", choice.study.seed},
                           {"kinds", nlohmann::json::array()}};
  for (const std::string& kind : choice.study.kinds) {
    for (const parts::Coordinates coordinates : choice.study.coordinates) {
      const PartsResult result = judge_parts(choice.study, kind, coordinates, complain);
      print_row(result);
      report["kinds"].push_back(to_json(result));
      experiments::write_report(choice.json, report);
      poses += result.poses;
      wrong += result.wrong_poses;
      show_cut += result.poses_that_show_cut;
      at_border += result.of_these_at_a_border;
      beside += result.poses_beside;
      nearest += result.judgements.front().nearest_asked;
      if (coordinates == parts::Coordinates::RECUT) recut += result.poses;
    }
  }
  fmt::print(
      "\nAt {} poses LMDs within roundings of an intersection were left out of what the cut may not change; "
      "at {} the nearest pair had to be an LMD.\n",
      beside, nearest);
  fmt::print(
      "{} of {} poses are wrong; at {} of {} the cut into triangles shows, {} at a border of the "
      "tolerance.\n",
      wrong, poses, show_cut, recut, at_border);
  return static_cast<int>(wrong + (show_cut - at_border) == 0 ? ExitCode::DONE : ExitCode::CHECK_FAILED);
}

}  // namespace
}  // namespace lmdbench::completeness

void lmdbench::study::add_parts(CLI::App& app, Run& chosen) {
  using namespace completeness;
  CLI::App* command =
      app.add_subcommand("parts", "Is certified right on machine parts that lie on and in each other?");
  const auto choice = std::make_shared<PartsChoiceOfUser>();
  const auto coordinates = std::make_shared<std::vector<std::string>>();
  const auto flush = std::make_shared<bool>(false);
  const auto generator = std::make_shared<std::string>("parts");
  choice->study.poses = 100;
  command->add_option("--poses", choice->study.poses,
                      "Poses of each kind of parts in each kind of coordinates");
  command->add_option("--seed", choice->study.seed, "Of the random numbers");
  command->add_option("--kind", choice->study.kinds,
                      "Such as 'ring on ring', may be repeated; all without it");
  command
      ->add_option(
          "--generator", *generator,
          "Without --kind: parts (drawn machine parts), solids (random ones) or shapes (turned, swept, slit, "
          "scanned)")
      ->check(CLI::IsMember(parts::HARD_GENERATORS));
  command->add_option("--coordinates", *coordinates,
                      "exact, turned, rounded or recut, may be repeated; all without it");
  command->add_flag("--flush", *flush, "Only poses without tilt, whose flat contacts are exact");
  command->add_option("--complaints", choice->complaints, "Wrong poses that are told");
  command->add_option("--json", choice->json, "File that the table is written to as well");
  command->callback([&chosen, command, choice, coordinates, flush, generator] {
    if (*flush) choice->study.family = parts::PoseFamily::FLUSH;
    for (const std::string& kind : choice->study.kinds) parts::parts_kind(kind);
    if (choice->study.kinds.empty())
      for (const parts::PartsKind& kind : parts::parts_kinds(parts::HARD_GENERATORS.at(*generator)))
        choice->study.kinds.emplace_back(kind.name);
    for (const parts::Coordinates each : parts::ALL_COORDINATES)
      if (coordinates->empty() ||
          std::find(coordinates->begin(), coordinates->end(), name_of(each)) != coordinates->end())
        choice->study.coordinates.push_back(each);
    chosen.work = [choice] { return judge_all(*choice); };
    chosen.pieces = [command, choice] {
      std::vector<std::string> names;
      for (const parts::Coordinates each : choice->study.coordinates) names.emplace_back(name_of(each));
      return study::pieces_by(*command, {{"--kind", choice->study.kinds}, {"--coordinates", names}});
    };
  });
  command->get_option("--coordinates")->check(CLI::IsMember({"exact", "turned", "rounded", "recut"}));
}
