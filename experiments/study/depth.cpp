// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/registry.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/completeness/judge.h>
#include <study/studies.h>
#include <support/bodies.h>
#include <support/program.h>
#include <support/timing.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

/// Cost of a frame at every depth of overlap: the moving mesh slides along x from where the boxes
/// are apart until the centres meet, turned a little, so that copies do not coincide. `certified`,
/// coherent and from scratch, is timed (least of several passes, processor time of one thread); in
/// some frames its sets are compared with `exhaustive`. Exit code 1 when a set is wrong.
namespace lmdbench::study {
namespace {

struct DepthChoice {
  experiments::SceneChoice scene;
  double cutoff = 0.005;  ///< Share of the diagonal.
  double turn = 0.1;      ///< rad
  std::size_t frames = 5000, passes = 5, truth_stride = 50, rows = 20;
  std::string json;
};

/// The two ways to run `certified` that are timed.
struct Way {
  const char* name;
  bool coherent;
  std::vector<double> seconds;  ///< One per frame: the least of the passes.
};

/// Depth 0: the boxes are a percent apart; 1: their centres nearly meet.
std::vector<Pose> slide(const Scene& scene, const DepthChoice& choice) {
  const Eigen::AlignedBox3d moving = bounding_box(scene.moving->surface().mesh),
                            fixed = bounding_box(scene.fixed[0].body->surface().mesh);
  const double diagonal = moving.diagonal().norm();
  const double reach = 0.5 * (moving.sizes().x() + fixed.sizes().x()) + 0.01 * diagonal;
  std::vector<Pose> poses(choice.frames + 1);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double depth = static_cast<double>(i) / static_cast<double>(choice.frames);
    poses[i].rotation = Eigen::AngleAxisd(choice.turn, Vec3::UnitZ());
    // A little beside the centre, so that nothing is symmetric.
    const Vec3 centre = fixed.center() + Vec3((1.0 - depth) * reach, 0.003 * diagonal, 0.002 * diagonal);
    poses[i].translation = centre - poses[i].rotation * moving.center();
  }
  return poses;
}

int slide_inwards(const DepthChoice& choice) {
  Scene scene = experiments::load_scene(choice.scene);
  scene.cutoff = choice.cutoff * choice.scene.diagonal;
  const std::vector<Pose> poses = slide(scene, choice);
  std::array<Way, 2> ways{Way{"coherent", true, {}}, Way{"from scratch", false, {}}};
  std::vector<std::size_t> lmds(poses.size()), exact_pairs(poses.size());
  for (Way& way : ways) way.seconds.assign(poses.size(), std::numeric_limits<double>::infinity());
  LmdSet set;
  for (std::size_t pass = 0; pass < choice.passes; ++pass)
    for (Way& way : ways) {
      Certified method(scene, {.frame_coherence = way.coherent});
      for (std::size_t i = 0; i < poses.size(); ++i) {
        WorkCounters counters;
        const double begin = experiments::thread_seconds();
        method.search(poses[i], set, counters);
        way.seconds[i] = std::min(way.seconds[i], experiments::thread_seconds() - begin);
        lmds[i] = set.size();
        exact_pairs[i] = counters[Certified::Counter::TRIANGLE_DISTANCES];
      }
    }

  completeness::Judgement judgement;
  std::string objections;
  if (choice.truth_stride > 0) {
    const auto exhaustive = make_method("exhaustive", scene, nlohmann::json::object());
    LmdSet truth;
    for (const Way& way : ways) {
      Certified method(scene, {.frame_coherence = way.coherent});
      for (std::size_t i = 0; i < poses.size(); ++i) {
        WorkCounters ignored;
        method.search(poses[i], set, ignored);
        if (i % choice.truth_stride != 0) continue;
        exhaustive->search(poses[i], truth, ignored);
        std::string objection;
        judgement += completeness::judge(truth, set, scene, choice.scene.diagonal, objection);
        if (!objection.empty()) objections += fmt::format("frame {}, {}: {}\n", i, way.name, objection);
      }
    }
  }

  fmt::print(
      "{} into {}, turned by {:g} rad, cutoff {:g} % of the diagonal: {} frames, the least of {} passes, "
      "processor time\n\n",
      choice.scene.moving, choice.scene.fixed, choice.turn, 100.0 * choice.cutoff, poses.size(),
      choice.passes);
  fmt::print(
      "| depth | LMDs | triangle pairs evaluated | coherent: median [us] | p99 | largest | from scratch: "
      "median [us] | p99 | largest |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  nlohmann::json report = {{"moving", choice.scene.moving}, {"fixed", choice.scene.fixed},
                           {"cutoff", choice.cutoff},       {"turn_rad", choice.turn},
                           {"frames", poses.size()},        {"passes", choice.passes}};
  for (std::size_t row = 0; row < choice.rows; ++row) {
    const std::size_t begin = row * poses.size() / choice.rows, end = (row + 1) * poses.size() / choice.rows;
    const auto part = [&](const auto& values) {
      return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                 values.begin() + static_cast<std::ptrdiff_t>(end));
    };
    const double depth = 0.5 * static_cast<double>(begin + end) / static_cast<double>(poses.size());
    fmt::print("| {:.3f} | {:g} | {:g} ", depth, median(part(lmds)), median(part(exact_pairs)));
    nlohmann::json entry = {
        {"depth", depth}, {"lmds", median(part(lmds))}, {"triangle_pairs", median(part(exact_pairs))}};
    for (const Way& way : ways) {
      const std::vector<double> seconds = part(way.seconds);
      const double largest = *std::max_element(seconds.begin(), seconds.end());
      fmt::print("| {:.1f} | {:.1f} | {:.1f} ", 1e6 * median(seconds), 1e6 * quantile(seconds, P99),
                 1e6 * largest);
      entry[way.name] = {
          {"median_s", median(seconds)}, {"p99_s", quantile(seconds, P99)}, {"largest_s", largest}};
    }
    fmt::print("|\n");
    report["rows"].push_back(entry);
  }
  fmt::print("\n");
  for (const Way& way : ways)
    fmt::print("Frames above 1 ms, {}: {} of {}\n", way.name,
               std::count_if(way.seconds.begin(), way.seconds.end(), [](double s) { return s > 1e-3; }),
               poses.size());
  fmt::print(
      "Against exhaustive: {} sets of {} LMDs, {} sets wrong, points off by {:.1e} diagonals at most\n{}",
      judgement.poses, judgement.same.true_lmds, judgement.wrong_poses, judgement.worst_point_difference,
      objections);
  experiments::write_report(choice.json, report);
  return judgement.wrong_poses == 0 ? 0 : 1;
}

}  // namespace

void add_depth(CLI::App& app, Run& chosen) {
  const auto choice = std::make_shared<DepthChoice>();
  CLI::App* command = app.add_subcommand("depth", "What does a frame cost at every depth of overlap?");
  experiments::add_mesh_options(*command, choice->scene);
  experiments::add_scene_options(*command, choice->scene);
  command->add_option("--cutoff", choice->cutoff, "Cutoff, share of the diagonal");
  command->add_option("--turn", choice->turn, "Turn of the moving mesh about z [rad]");
  command->add_option("--frames", choice->frames, "Frames from apart to the deepest")
      ->check(CLI::PositiveNumber);
  command->add_option("--passes", choice->passes, "Times the path is run")->check(CLI::PositiveNumber);
  command->add_option("--rows", choice->rows, "Rows of the table")->check(CLI::PositiveNumber);
  command->add_option("--truth-stride", choice->truth_stride,
                      "Compare every so many frames with exhaustive; 0: none");
  command->add_option("--json", choice->json, "Also write the table to this file");
  command->callback([choice, &chosen] { chosen.work = [choice] { return slide_inwards(*choice); }; });
}

}  // namespace lmdbench::study
