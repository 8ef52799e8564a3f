// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/pieces.h>
#include <study/recall/variant.h>
#include <study/studies.h>
#include <support/poses.h>
#include <support/program.h>

#include <algorithm>
#include <memory>

/// Recall and precision of the paper's algorithms against the truth at random grazing poses, step
/// by step. Markdown on standard output, JSON in a file. Exit code 1 when the cones alone lose an
/// LMD, because they must be conservative.
namespace lmdbench::recall_study {
namespace {

void print_table(const std::string& title, const std::vector<VariantResult>& results) {
  fmt::print("\n{}\n\n", title);
  fmt::print(
      "| variant | found of true | recall | precision | recall, adjacent | precision, adjacent | poses with "
      "loss | nearest missed |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const VariantResult& result : results) {
    const Agreement &same = result.error.same, &neighbours = result.error.neighbours;
    fmt::print("| {} | {} of {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {} | {} |\n", result.variant.label,
               same.found, same.true_lmds, same.recall(), same.precision(), neighbours.recall(),
               neighbours.precision(), result.poses_with_loss, result.error.minimum_missed);
  }
}

nlohmann::json to_json(const VariantResult& result) {
  return {{"variant", result.variant.label},
          {"method", result.variant.method},
          {"options", result.variant.options},
          {"trackings", result.variant.trackings},
          {"set", experiments::error_json(result.error.same, result.error.neighbours)},
          {"poses_with_loss", result.poses_with_loss},
          {"minimum_missed", result.error.minimum_missed}};
}

std::vector<VariantResult> judge_all(const std::vector<Variant>& variants, const Scene& scene,
                                     const std::vector<Pose>& poses, const experiments::Truth& truth) {
  std::vector<VariantResult> results;
  for (const Variant& variant : variants) results.push_back(judge(variant, scene, poses, truth));
  return results;
}

int measure_recall(const experiments::StudyChoice& choice) {
  Scene scene = load_scene(choice.scene);
  const double diagonal = choice.scene.diagonal;
  const std::vector<Pose> poses = experiments::grazing_poses(
      *scene.moving, *scene.fixed.at(0), choice.scene.gap * diagonal, choice.poses, choice.seed);
  fmt::print("## {} on {}\n\n{} random poses at gap {:g} % of the diagonal, seed {}\n", choice.scene.moving,
             choice.scene.fixed, poses.size(), 100.0 * choice.scene.gap, choice.seed);

  // The cutoff only decides whether an LMD counts: the truth of the largest contains the others.
  scene.cutoff = *std::max_element(choice.cutoffs.begin(), choice.cutoffs.end()) * diagonal;
  const experiments::Truth all_truth = experiments::exhaustive_truth(scene, poses);

  nlohmann::json report = {{"moving", choice.scene.moving}, {"fixed", choice.scene.fixed},
                           {"diagonal_m", diagonal},        {"gap", choice.scene.gap},
                           {"poses", poses.size()},         {"seed", choice.seed}};
  bool cones_conservative = true;
  for (const double cutoff : choice.cutoffs) {
    scene.cutoff = cutoff * diagonal;
    experiments::Truth truth;
    for (const LmdSet& set : all_truth) truth.push_back(within_cutoff(set, scene.cutoff));
    const std::vector<VariantResult> improved = judge_all(improved_variants(), scene, poses, truth);
    const std::vector<VariantResult> original = judge_all(original_variants(), scene, poses, truth);
    print_table(fmt::format("### Improved, cutoff {:g} % of the diagonal", 100.0 * cutoff), improved);
    print_table(fmt::format("### Original, cutoff {:g} % of the diagonal", 100.0 * cutoff), original);
    cones_conservative = cones_conservative && improved.front().error.same.missed() == 0;
    nlohmann::json entry = {{"cutoff", cutoff}};
    for (const VariantResult& result : improved) entry["improved"].push_back(to_json(result));
    for (const VariantResult& result : original) entry["original"].push_back(to_json(result));
    report["cutoffs"].push_back(entry);
  }
  experiments::write_report(choice.json, report);
  if (!cones_conservative) fmt::print(stderr, "error: the cone tests alone lost true LMDs\n");
  return cones_conservative ? 0 : 1;
}

}  // namespace
}  // namespace lmdbench::recall_study

void lmdbench::study::add_recall(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand("recall", "Where the paper's algorithms lose LMDs");
  const auto choice = std::make_shared<experiments::StudyChoice>();
  choice->seed = 2;
  experiments::add_mesh_options(*command, choice->scene);
  experiments::add_study_options(*command, *choice);
  command->callback([&chosen, command, choice] {
    chosen.work = [choice] { return recall_study::measure_recall(*choice); };
    chosen.pieces = [command, choice] { return pieces_by(*command, {{"--cutoff", texts(choice->cutoffs)}}); };
  });
}
