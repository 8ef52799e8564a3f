// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/polar_condition.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/registry.h>

#include <benchmarks/global_search/implementation.h>
#include <fmt/format.h>
#include <study/scaling/measure.h>
#include <study/scaling/slide.h>
#include <support/poses.h>
#include <support/timing.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace lmdbench::scaling {
namespace {

/// Relative; poses reach the gap to within GAP_TOLERANCE, and FCL is judged with 1e-6 elsewhere.
constexpr double MINIMUM_TOLERANCE = 2.0 * experiments::GAP_TOLERANCE;

bool same_set(const LmdSet& a, const LmdSet& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_feature_pair);
}

/// Each pair once: the paper's searches yield candidates, which may repeat pairs.
void judge(Series& series, const LmdSet& truth, const LmdSet& lmds, const Scene& scene) {
  const LmdSet reported = distinct_pairs(lmds);
  series.same += agreement(truth, reported, Match::SAME_FEATURES, scene);
  series.neighbours += agreement(truth, reported, Match::NEIGHBOURING_FEATURES, scene);
}

std::string minimum_objection(double minimum, const MeasureChoice& choice, double cutoff) {
  if (choice.gap > cutoff) return std::isnan(minimum) ? "" : "found something beyond the cutoff";
  const double relative = std::abs(minimum - choice.gap) / choice.gap;
  // Written so that NaN objects.
  return relative <= MINIMUM_TOLERANCE ? ""
                                       : fmt::format("minimum distance off by {:.2g} of itself", relative);
}

/// Whether the nearest pair is an LMD. On a broken mesh it may not be one: a sheet that is inverted
/// or lies twice at the same place has its outer side elsewhere.
bool nearest_pair_is_lmd(const Scene& scene, const Pose& X_WM) {
  const Surface& moving = scene.moving->surface();
  const Surface& fixed = scene.fixed.at(0)->surface();
  const NearestPair nearest = nearest_pair(*scene.moving, *scene.fixed[0], X_WM);
  const Vec3 &p_W = nearest.pair.point_a, &q_W = nearest.pair.point_b;
  // No wing leads from it to a nearer point.
  return is_outer(moving, moving.feature_of(nearest.triangle_moving, nearest.pair.feature_a),
                  X_WM.rotation.inverse() * (q_W - p_W)) &&
         is_outer(fixed, fixed.feature_of(nearest.triangle_fixed, nearest.pair.feature_b), p_W - q_W);
}

/// The peers of `certified`: FCL and the other methods that are not brute force.
std::vector<experiments::SearchImplementation> peer_searches() {
  std::vector<experiments::SearchImplementation> peers;
  for (const experiments::SearchImplementation& search : experiments::method_searches())
    if (!search.slow && search.promise != Promise::COMPLETE_SET) peers.push_back(search);
  peers.push_back(experiments::fcl_cold_search());
  return peers;
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Measurement measure(const Scene& scene, const std::vector<Pose>& poses, const MeasureChoice& choice) {
  const Body& moving = *scene.moving;
  const Body& fixed = *scene.fixed.at(0);
  experiments::Random random(choice.seed);
  std::vector<std::vector<Pose>> slides;
  for (const Pose& pose : poses)
    slides.push_back(lead_in(moving, fixed, pose, bounding_box_diagonal(moving.surface().mesh),
                             choice.lead_in_frames, random));

  Measurement result;
  std::vector<experiments::TimedTask> tasks;
  std::vector<LmdSet> truth(poses.size());

  const auto certified = [&](bool coherent) {
    return Runner{make_method("certified", scene, {{"frame_coherence", coherent}})};
  };
  Runner scratch = certified(false), sliding = certified(false), coherent = certified(true);
  const auto slide_to = [&slides](Runner& runner, std::size_t pose) {
    for (const Pose& frame : slides[pose]) runner.search(frame);
  };
  const auto add_certified = [&](const std::string& name, Runner& runner, bool slides_first) {
    Series series;
    series.name = name;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (slides_first) slide_to(runner, i);
      runner.search(poses[i]);
      series.counters.push_back(runner.counters);
      if (result.series.empty()) truth[i] = runner.lmds;
      const std::string wrong = minimum_objection(minimum_distance(runner.lmds), choice, scene.cutoff);
      if (!wrong.empty() && nearest_pair_is_lmd(scene, poses[i]))
        series.objection = fmt::format("pose {}: {}", i, wrong);
      if (!same_set(truth[i], runner.lmds))
        series.objection = fmt::format("pose {}: not the set that is found from scratch", i);
      judge(series, truth[i], runner.lmds, scene);
    }
    result.series.push_back(series);
    experiments::TimedTask task{name, [&runner, &poses](std::size_t pose) { runner.search(poses[pose]); }};
    if (slides_first) task.prepare = [&runner, &slide_to](std::size_t pose) { slide_to(runner, pose); };
    tasks.push_back(std::move(task));
  };
  add_certified("certified", scratch, false);
  add_certified("certified sliding", sliding, true);
  add_certified("certified coherent", coherent, true);
  for (const LmdSet& set : truth) result.lmd_counts.push_back(set.size());

  std::vector<std::unique_ptr<experiments::GlobalSearch>> peers;
  for (const experiments::SearchImplementation& implementation : peer_searches()) {
    peers.push_back(implementation.make(scene));
    experiments::GlobalSearch* peer = peers.back().get();
    Series series;
    series.name = implementation.name;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      peer->run(poses[i]);
      if (const LmdSet* lmds = peer->lmds()) {
        judge(series, truth[i], *lmds, scene);
      } else {
        const std::string wrong =
            minimum_objection(peer->minimum_distance(), choice, std::numeric_limits<double>::infinity());
        if (!wrong.empty()) series.objection = fmt::format("pose {}: {}", i, wrong);
      }
    }
    result.series.push_back(series);
    tasks.push_back({implementation.name, [peer, &poses](std::size_t pose) { peer->run(poses[pose]); }});
  }

  const auto seconds = experiments::time_interleaved(tasks, poses.size(), choice.repetitions);
  for (std::size_t i = 0; i < tasks.size(); ++i) result.series[i].seconds = seconds[i];
  return result;
}

BuildCost measure_build(const TriangleMesh& mesh) {
  constexpr int RUNS = 3;
  constexpr double INFINITE = std::numeric_limits<double>::infinity();
  BuildCost cost{INFINITE, INFINITE, INFINITE, INFINITE};
  for (int run = 0; run < RUNS; ++run) {
    TriangleMesh copy = mesh;
    const double start = wall_seconds(), start_cpu = experiments::process_seconds();
    const Surface surface = build_surface(std::move(copy));
    const double middle = wall_seconds(), middle_cpu = experiments::process_seconds();
    const WideHierarchy hierarchy = build_wide_hierarchy(surface);
    const double end_cpu = experiments::process_seconds();
    cost.surface_seconds = std::min(cost.surface_seconds, middle - start);
    cost.surface_cpu_seconds = std::min(cost.surface_cpu_seconds, middle_cpu - start_cpu);
    cost.wide_hierarchy_seconds = std::min(cost.wide_hierarchy_seconds, wall_seconds() - middle);
    cost.wide_hierarchy_cpu_seconds = std::min(cost.wide_hierarchy_cpu_seconds, end_cpu - middle_cpu);
    cost.surface_bytes = surface.bytes();
    cost.wide_hierarchy_bytes = hierarchy.bytes();
    cost.features = hierarchy.feature_count;
  }
  return cost;
}

}  // namespace lmdbench::scaling
