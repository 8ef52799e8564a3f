// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/lmd/agreement.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/studies.h>
#include <support/context.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/timing.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// `certified` on meshes that deform: whether its set is the true one in every frame, the cost of
/// following, and how good refitted bounds are against new ones. Exit code 1 when a set is wrong.
namespace lmdbench::study {
namespace {

struct DeformChoice {
  std::filesystem::path meshes = "meshes";
  std::vector<std::string> parts = {"truth", "cost"};
  std::vector<std::string> truth_meshes = {"small-blob", "box"};
  std::string other = "torus";
  std::string large = "bunny-16k";
  std::size_t frames = 1000;
  std::size_t stride = 10;
  std::uint64_t seed = 1;
  std::string json;
};

constexpr double DIAGONAL = 0.15;  ///< Of all meshes [m].
constexpr double GAP = 0.002;      ///< At rest, as a share of the diagonal.
/// The frames are split among so many poses, so that no single contact decides the result.
constexpr std::size_t POSES = 10;

/// A deformation of the study; all oscillate with `period` frames.
struct Kind {
  std::string name;
  DeformationChoice choice;
  double period = 500.0;
  double fold = 0.0;  ///< If not 0: a fold instead; turn of each half [rad].
};

std::vector<Kind> all_kinds() {
  const Vec3 up = Vec3::UnitY();
  std::vector<Kind> kinds{
      {"ear: bends by 1 rad, 8 % of the vertices", {DeformationKind::BEND, 1.0, 0.08, up, 0}},
      {"whole, bends by 1 rad", {DeformationKind::BEND, 1.0, 1.0, up, 0}},
      {"whole, twists by 720 degrees", {DeformationKind::TWIST, 4.0 * std::numbers::pi, 1.0, up, 0}},
      {"dent of 10 %, 20 % of the vertices", {DeformationKind::DENT, 0.1, 0.2, up, 0}},
      {"breathes by 10 %", {DeformationKind::BREATHE, 0.1, 1.0, up, 0}},
      {"crumples by 2 %", {DeformationKind::CRUMPLE, 0.02, 1.0, up, 5}}};
  return kinds;
}

/// Folds of a level sheet to a ridge, to a valley and back, by the angle of each half.
std::vector<Kind> all_folds() {
  std::vector<Kind> kinds;
  for (const double angle : {1e-9, 1e-3, 10.0 * std::numbers::pi / 180.0})
    kinds.push_back({fmt::format("sheet creased by {:.2g} rad", angle), {}, 500.0, angle});
  return kinds;
}

/// Vertices of a mesh in each frame.
class Frames {
 public:
  Frames(const TriangleMesh& mesh, const Kind& kind) : rest_(mesh.vertices), kind_(kind) {
    if (kind.fold == 0.0) deformation_.emplace(mesh, kind.choice);
  }
  void at(std::size_t frame, std::vector<Vec3>& vertices) const {
    const double phase = static_cast<double>(frame) / kind_.period;
    if (deformation_) {
      deformation_->at(phase, vertices);
      return;
    }
    vertices = rest_;
    // Level for a part of each period, so that both halves become one plane again.
    const double strength = std::clamp(1.5 * std::sin(2.0 * std::numbers::pi * phase), -1.0, 1.0);
    const double fold = std::abs(strength) < 0.3 ? 0.0 : std::tan(strength * kind_.fold);
    for (Vec3& p : vertices) p.z() -= fold * std::abs(p.x());
  }

 private:
  std::vector<Vec3> rest_;
  const Kind& kind_;
  std::optional<Deformation> deformation_;
};

/// The pose of the frame's share of the run, swung a little about an axis.
Pose swung(const std::vector<Pose>& poses, std::size_t frame, std::size_t frames) {
  Pose pose = poses[frame * poses.size() / frames];
  const double phase = 0.02 * static_cast<double>(frame);
  const Vec3 axis = Vec3(1.0, 2.0, 3.0).normalized();
  pose.rotation = (Eigen::Quaterniond(Eigen::AngleAxisd(0.02 * std::sin(1.3 * phase), axis)) * pose.rotation)
                      .normalized();
  pose.translation += 0.004 * DIAGONAL * std::sin(phase) * axis;
  return pose;
}

bool same_bits(const LmdSet& a, const LmdSet& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Lmd& x, const Lmd& y) {
    return same_feature_pair(x, y) && x.distance == y.distance && x.point_moving == y.point_moving &&
           x.point_fixed == y.point_fixed;
  });
}

/// Processor time [s] of all threads, which other programs affect least.
template <class Work>
double processor_seconds_of(Work&& work) {
  const double start = experiments::process_seconds();
  work();
  return experiments::process_seconds() - start;
}

std::shared_ptr<const Body> body_of(const TriangleMesh& mesh) {
  return std::make_shared<const Body>("mesh", build_surface(mesh));
}

/// Set of the method that follows, against the truth and a method made for each frame's mesh.
nlohmann::json measure_truth(const DeformChoice& choice, const std::string& name, const Kind& kind,
                             double cutoff) {
  const auto rest = experiments::load_body(name, choice.meshes, DIAGONAL);
  const auto other = experiments::load_body(choice.other, choice.meshes, DIAGONAL);
  const std::vector<Pose> poses =
      experiments::grazing_poses(*rest, *other, GAP * DIAGONAL, POSES, choice.seed);
  const TriangleMesh& mesh = rest->surface().mesh;
  const Frames shapes(mesh, kind);
  const auto body = std::make_shared<Body>(name, build_surface(mesh));
  const Scene scene{body, {other}, cutoff * DIAGONAL};
  Certified kept(scene);
  Agreement agreement_of_all;
  std::size_t other_bits = 0, turned_over = 0;
  double largest_distance_error = 0.0;
  LmdSet of_kept, of_fresh, truth;
  WorkCounters counters;
  std::vector<Vec3> vertices;
  for (std::size_t frame = 0; frame < choice.frames; ++frame) {
    shapes.at(frame, vertices);
    turned_over += static_cast<std::size_t>(body->deform(vertices).turned_over);
    TriangleMesh now = mesh;
    now.vertices = vertices;
    const Scene fresh_scene{body_of(now), {other}, scene.cutoff};
    const Pose X_WM = swung(poses, frame, choice.frames);
    kept.search(X_WM, of_kept, counters);
    Certified(fresh_scene).search(X_WM, of_fresh, counters);
    Exhaustive(fresh_scene).search(X_WM, truth, counters);
    other_bits += same_bits(of_kept, of_fresh) ? 0 : 1;
    const Agreement here = agreement(truth, of_kept, Match::SAME_FEATURES, fresh_scene);
    if (here.exact())
      for (std::size_t i = 0; i < truth.size(); ++i)
        largest_distance_error =
            std::max(largest_distance_error, std::abs(truth[i].distance - of_kept[i].distance));
    agreement_of_all += here;
  }
  return {{"mesh", name},
          {"deformation", kind.name},
          {"cutoff", cutoff},
          {"frames", choice.frames},
          {"turned_over", turned_over},
          {"true_lmds", agreement_of_all.true_lmds},
          {"missed", agreement_of_all.missed()},
          {"wrong", agreement_of_all.wrong()},
          {"largest_distance_error", largest_distance_error / DIAGONAL},
          {"frames_of_other_bits", other_bits}};
}

/// Cost of following, and cost of a search from scratch with refitted bounds and with new ones.
nlohmann::json measure_cost(const DeformChoice& choice, const Kind& kind) {
  const auto rest = experiments::load_body(choice.large, choice.meshes, DIAGONAL);
  const std::vector<Pose> poses =
      experiments::grazing_poses(*rest, *rest, GAP * DIAGONAL, POSES, choice.seed);
  const TriangleMesh& mesh = rest->surface().mesh;
  const Frames shapes(mesh, kind);
  const auto body = std::make_shared<Body>(choice.large, build_surface(mesh));
  const Scene scene{body, {rest}, 0.02 * DIAGONAL};
  Certified kept(scene), scratch(scene, {.frame_coherence = false});
  const auto& hierarchy = body->prepared<WideHierarchy>();
  body->deform(mesh.vertices);  // moves nothing; prepares the other steps
  using Counter = Certified::Counter;
  std::vector<double> following, searching, preparing, faces;
  WorkCounters of_kept, of_scratch, of_scratch_then, of_fresh;
  LmdSet lmds;
  std::vector<Vec3> vertices;
  for (std::size_t frame = 0; frame < choice.frames; ++frame) {
    shapes.at(frame, vertices);
    following.push_back(processor_seconds_of(
        [&] { faces.push_back(static_cast<double>(body->deform(vertices).faces.size())); }));
    const Pose X_WM = swung(poses, frame, choice.frames);
    searching.push_back(processor_seconds_of([&] { kept.search(X_WM, lmds, of_kept); }));
    scratch.search(X_WM, lmds, of_scratch);
    if (frame % choice.stride != 0) continue;
    TriangleMesh now = mesh;
    now.vertices = vertices;
    std::shared_ptr<const Body> fresh;
    preparing.push_back(processor_seconds_of([&] {
      fresh = body_of(now);
      fresh->prepared<WideHierarchy>();
    }));
    Certified(Scene{fresh, {rest}, scene.cutoff}, {.frame_coherence = false}).search(X_WM, lmds, of_fresh);
    scratch.search(X_WM, lmds, of_scratch_then);
  }
  const auto tests = [](const WorkCounters& counters) {
    return static_cast<double>(counters[Counter::NODE_PAIRS]);
  };
  return {{"deformation", kind.name},
          {"frames", choice.frames},
          {"faces", median(faces)},
          {"follow_median_s", median(following)},
          {"follow_p99_s", quantile(following, P99)},
          {"follow_maximum_s", maximum(following)},
          {"search_median_s", median(searching)},
          {"prepare_median_s", median(preparing)},
          {"times_built_anew", hierarchy.times_built_anew()},
          {"node_tests_over_fresh", tests(of_scratch_then) / tests(of_fresh)},
          {"node_tests_kept_over_scratch", tests(of_kept) / tests(of_scratch)}};
}

int run_deform(const DeformChoice& choice) {
  const std::set<std::string> parts(choice.parts.begin(), choice.parts.end());
  nlohmann::json truth = nlohmann::json::array(), cost = nlohmann::json::array();
  bool right = true;
  if (parts.contains("truth")) {
    fmt::print(
        "| mesh, against {} | deformation | cutoff [%] | frames | true LMDs | missed | wrong | distance "
        "error "
        "[diagonals] | frames of other bits than fresh | triangles turned over "
        "|\n|---|---|---|---|---|---|---|---|---|---|\n",
        choice.other);
    const auto measure = [&](const std::string& mesh, const Kind& kind) {
      for (const double cutoff : {0.005, 0.02, 0.05}) {
        const nlohmann::json& row = truth.emplace_back(measure_truth(choice, mesh, kind, cutoff));
        fmt::print("| {} | {} | {:g} | {} | {} | {} | {} | {:.2g} | {} | {} |\n", mesh, kind.name,
                   100.0 * cutoff, choice.frames, row["true_lmds"].get<std::size_t>(),
                   row["missed"].get<std::size_t>(), row["wrong"].get<std::size_t>(),
                   row["largest_distance_error"].get<double>(),
                   row["frames_of_other_bits"].get<std::size_t>(), row["turned_over"].get<std::size_t>());
        std::fflush(stdout);
        right = right && row["missed"] == 0 && row["wrong"] == 0 && row["frames_of_other_bits"] == 0;
      }
    };
    for (const std::string& mesh : choice.truth_meshes)
      for (const Kind& kind : all_kinds()) measure(mesh, kind);
    for (const Kind& kind : all_folds()) measure("plate", kind);
    fmt::print("\n");
  }
  if (parts.contains("cost")) {
    fmt::print(
        "| {} deforms, against itself | triangles that change | follow: median [ms of processor time] | 99 % "
        "| largest | "
        "prepare anew [ms] "
        "| search that keeps [us] | times built anew | node tests of a search from scratch over a fresh "
        "build's | kept over "
        "from scratch |\n|---|---|---|---|---|---|---|---|---|---|\n",
        choice.large);
    for (const Kind& kind : all_kinds()) {
      const nlohmann::json& row = cost.emplace_back(measure_cost(choice, kind));
      const auto ms = [&](const char* key) { return 1e3 * row[key].get<double>(); };
      fmt::print("| {} | {} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {} | {:.3f} | {:.3f} |\n",
                 kind.name, row["faces"].get<double>(), ms("follow_median_s"), ms("follow_p99_s"),
                 ms("follow_maximum_s"), ms("prepare_median_s"), 1e3 * ms("search_median_s"),
                 row["times_built_anew"].get<int>(), row["node_tests_over_fresh"].get<double>(),
                 row["node_tests_kept_over_scratch"].get<double>());
      std::fflush(stdout);
    }
  }
  experiments::write_report(choice.json,
                            {{"context", experiments::run_context()}, {"truth", truth}, {"cost", cost}});
  return right ? 0 : 1;
}

}  // namespace

void add_deform(CLI::App& app, Run& chosen) {
  auto choice = std::make_shared<DeformChoice>();
  CLI::App* command = app.add_subcommand(
      "deform", "meshes that deform: the set against the truth in every frame, and what following costs");
  command->add_option("--part", choice->parts, "what to measure")->check(CLI::IsMember({"truth", "cost"}));
  command->add_option("--meshes", choice->meshes, "folder of the manifest");
  command->add_option("--mesh", choice->truth_meshes, "meshes that deform, for the truth");
  command->add_option("--other", choice->other, "mesh that they meet there");
  command->add_option("--large", choice->large, "mesh whose following is timed");
  command->add_option("--frames", choice->frames, "frames of each deformation")
      ->check(CLI::Range(std::size_t{POSES}, std::size_t{1000000}));
  command->add_option("--stride", choice->stride, "frames from one mesh that is prepared anew to the next")
      ->check(CLI::PositiveNumber);
  command->add_option("--seed", choice->seed, "of the poses");
  command->add_option("--json", choice->json, "file for the numbers");
  command->callback([choice, &chosen] { chosen.work = [choice] { return run_deform(*choice); }; });
}

}  // namespace lmdbench::study
