// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/lmd/body.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <study/scaling/builder_counts.h>
#include <study/scaling/measure.h>
#include <study/studies.h>
#include <support/bodies.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/timing.h>

#include <array>
#include <cstdio>
#include <memory>

/// Builders of the wide hierarchy compared by what their trees cost a search. Markdown on standard output;
/// results/reference/builders.md holds one run.
namespace lmdbench::scaling {
namespace {

struct BuilderChoice {
  experiments::SceneChoice scene;
  std::size_t poses = 40;
  std::uint64_t seed = 1;
};

constexpr std::array<double, 3> CUTOFFS{0.005, 0.02, 0.05};
/// Share of the diagonal at or below which faces touch: far below the gap.
constexpr double TOUCH = 1e-9;

/// A way to build, and to walk over what was built.
struct Variant {
  std::string name;
  WideBuildOptions options;
  CountRule rule;
};

std::vector<Variant> all_variants() {
  std::vector<Variant> variants;
  const auto add = [&](const std::string& name, const CountRule& rule, const auto& change) {
    WideBuildOptions options;
    change(options);
    variants.push_back({name, options, rule});
  };
  add("POSITION, full nodes, width 8, one feature a lane (default)", {}, [](auto&) {});
  add("halved at the middle", {}, [](auto& o) { o.full_nodes = false; });
  for (const double weight : {0.03, 0.1, 0.3}) {
    add(fmt::format("NORMAL, weight {:g}", weight), {}, [&](auto& o) {
      o.split = WideSplit::NORMAL;
      o.normal_weight = weight;
    });
  }
  add("ORDER", {}, [](auto& o) { o.split = WideSplit::ORDER; });
  add("one-ring cones", {}, [](auto& o) { o.tight_caps = false; });
  add("width 2", {}, [](auto& o) { o.width = 2; });
  add("width 4", {}, [](auto& o) { o.width = 4; });
  add("width 16", {2, 1}, [](auto& o) { o.width = 4; });
  for (const std::size_t leaf : {2u, 4u, 8u})
    add(fmt::format("{} features a lane", leaf), {1, leaf}, [&](auto& o) { o.leaf_size = leaf; });
  return variants;
}

std::string row(const Variant& variant, const BuilderChoice& choice, const Surface& moving,
                const Surface& fixed, const std::vector<Pose>& poses) {
  const double start = experiments::process_seconds();
  const WideHierarchy a = build_wide_hierarchy(moving, variant.options);
  const double seconds = experiments::process_seconds() - start;
  const WideHierarchy b = build_wide_hierarchy(fixed, variant.options);
  std::string tests, lanes, pairs;
  for (const double cutoff : CUTOFFS) {
    std::vector<double> of_tests, of_lanes, of_pairs;
    for (const Pose& pose : poses) {
      const WideQuery query(a, b, RigidTransform(pose), cutoff * choice.scene.diagonal,
                            TOUCH * choice.scene.diagonal);
      const TraversalCounts counts = count_traversal(a, b, query, variant.rule);
      of_tests.push_back(static_cast<double>(counts.tests));
      of_lanes.push_back(static_cast<double>(counts.lanes));
      of_pairs.push_back(static_cast<double>(counts.feature_pairs));
    }
    const char* between = tests.empty() ? "" : " / ";
    tests += fmt::format("{}{:.0f}", between, median(of_tests));
    lanes += fmt::format("{}{:.0f}", between, median(of_lanes));
    pairs += fmt::format("{}{:.0f}", between, median(of_pairs));
  }
  const auto triangles = static_cast<double>(moving.mesh.triangles.size());
  return fmt::format("| {} | {} | {} | {} | {:.2f} | {:.0f} |\n", variant.name, tests, lanes, pairs,
                     1e6 * seconds / triangles,
                     bytes_with_rule(a, variant.rule, variant.options.width) / triangles);
}

int compare_builders(const BuilderChoice& choice) {
  const Scene scene = experiments::load_scene(choice.scene);
  const Body& moving = *scene.moving;
  const Body& fixed = *scene.fixed.at(0);
  const std::vector<Pose> poses = experiments::grazing_poses(
      moving, fixed, choice.scene.gap * choice.scene.diagonal, choice.poses, choice.seed);
  fmt::print(
      "\n### {} on {}\n\nWidth 16 is the tree of width 4 read two levels at a time, and takes as long to "
      "build. "
      "Features that share a lane are paired untested, and the bounds of each are not reckoned among the "
      "bytes.\n\n",
      moving.name(), fixed.name());
  fmt::print(
      "Medians over {} random poses at a gap of {:g} % of the diagonal; cutoffs 0.5 / 2 / 5 % of it.\n\n",
      choice.poses, 100.0 * choice.scene.gap);
  fmt::print(
      "| builder | node tests | children tested | feature pairs left | building [us of processor time a "
      "triangle] | bytes a triangle |\n|---|---|---|---|---|---|\n");
  for (const Variant& variant : all_variants()) {
    fmt::print("{}", row(variant, choice, moving.surface(), fixed.surface(), poses));
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace lmdbench::scaling

void lmdbench::study::add_builders(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand(
      "builders", "Builders of the wide hierarchy, by the work that their trees leave to a search");
  const auto choice = std::make_shared<scaling::BuilderChoice>();
  experiments::add_mesh_options(*command, choice->scene);
  experiments::add_scene_options(*command, choice->scene);
  command->add_option("--poses", choice->poses, "Random poses")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--seed", choice->seed, "Seed of the poses")->capture_default_str();
  command->callback(
      [&chosen, choice] { chosen.work = [choice] { return scaling::compare_builders(*choice); }; });
}
