// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/probes/fcl_probe.h>
#include <lmdbench/probes/nearest_judge.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/snch/minimum_distance.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace lmdbench {
namespace {

/// FCL's nearest pair: of instances by nearest boxes first, of movers by pairs with nearest spheres
/// first, each at the relative pose that methods see.
class FclMinimum {
 public:
  explicit FclMinimum(const Scene& scene) : scene_(scene), near_(scene) {
    if (scene.several_move()) return;
    if (scene.is_world()) {
      phase_.emplace(scene);
      return;
    }
    std::vector<const Surface*> fixed;
    for (const auto& body : scene.fixed) fixed.push_back(&body->surface());
    all_.emplace(scene.moving->surface(), fixed);
  }

  FclResult at(const Pose& X_WM) {
    if (all_) return all_->distance(X_WM);
    FclResult best;
    // Of equally near pairs the first by number, or the one with nearer spheres.
    const auto look = [&](const ObjectPair& pair, bool by_number) {
      const FclResult found = distance_of(pair, X_WM);
      const std::int32_t number = pair.number(scene_);
      const bool is_tie = best.fixed_body >= 0 && found.distance == best.distance;
      if (best.fixed_body >= 0 && !(found.distance < best.distance) &&
          !(by_number && is_tie && number < best.fixed_body))
        return;
      best = found;
      best.fixed_body = number;
    };
    if (phase_) {
      phase_->by_distance(X_WM, [&](std::uint32_t instance, double bound) {
        if (best.fixed_body >= 0 && bound > best.distance) return false;
        look({0, instance + 1}, true);
        return true;
      });
      return best;
    }
    for (const auto& [at_least, objects] : near_.within(std::numeric_limits<double>::infinity(), X_WM)) {
      if (best.fixed_body >= 0 && at_least > best.distance) break;
      look(objects, false);
    }
    return best;
  }

 private:
  FclResult distance_of(const ObjectPair& pair, const Pose& X_WM) {
    const std::pair key(scene_.body(pair.mover).get(), scene_.body(pair.other).get());
    auto check = checks_.find(key);
    if (check == checks_.end())
      check =
          checks_.try_emplace(key, key.first->surface(), std::vector<const Surface*>{&key.second->surface()})
              .first;
    return check->second.distance(
        relative_pose(scene_.pose(pair.other, X_WM), scene_.pose(pair.mover, X_WM)));
  }

  const Scene& scene_;
  std::optional<FclCrosscheck> all_;  ///< Of fixed meshes not placed.
  std::optional<BroadPhase> phase_;   ///< Of instances.
  NearPairs near_;                    ///< Of movers.
  std::map<std::pair<const Body*, const Body*>, FclCrosscheck> checks_;
};

/// Exact nearest pair of any two objects, frame after frame.
class ExactMinimum {
 public:
  /// @param warm  whether a search starts from the last one's triangles
  /// @param moves whether more than the moving mesh moves
  ExactMinimum(const Scene& scene, bool warm, bool moves) : scene_(scene), warm_(warm) {
    if (scene.several_move() || (scene.is_world() && moves))
      objects_.emplace(scene);
    else if (scene.is_world())
      phase_.emplace(scene);
    else
      start();
  }

  NearestObjects::Nearest at(const Pose& X_WM) {
    if (objects_) return objects_->at(X_WM);
    NearestObjects::Nearest nearest;
    const auto is_of = [&](std::size_t fixed) {
      return ObjectPair{0, static_cast<std::uint32_t>(fixed) + 1};
    };
    if (phase_) {
      const NearestInstance found = nearest_instance(scene_, *phase_, X_WM);
      nearest = {found.distance, {}, found.triangle_moving, found.triangle_fixed};
      if (found.instance >= 0) nearest.objects = is_of(static_cast<std::size_t>(found.instance));
      return nearest;
    }
    if (!warm_) start();
    for (std::size_t i = 0; i < trackers_.size(); ++i) {
      const NearestPair pair = trackers_[i].nearest(X_WM);
      if (pair.triangle_moving >= 0 && pair.distance < nearest.distance)
        nearest = {pair.distance, is_of(i), pair.triangle_moving, pair.triangle_fixed};
    }
    return nearest;
  }

 private:
  void start() {
    trackers_.clear();
    for (const auto& fixed : scene_.fixed)
      trackers_.emplace_back(scene_.moving->surface(), scene_.moving->prepared<Hierarchy>(), fixed->surface(),
                             fixed->prepared<Hierarchy>());
  }

  const Scene& scene_;
  bool warm_;
  std::optional<NearestObjects> objects_;
  std::optional<BroadPhase> phase_;  ///< Of instances at rest.
  std::vector<NearestTracker> trackers_;
};

/// The distances of a frame.
struct FclAnswers {
  std::int64_t frame;
  const Pose& X_WM;
  const FclResult& theirs;
  double exact;                           ///< [m]
  std::array<NamedTriangles, 2> nearest;  ///< By FCL and by the exact search.
  double cutoff, tolerance_relative;
};

/// Compares FCL's distance with the exact one and with that of each method.
/// @param search finds the set of a method
template <typename Search>
void add_fcl_frame(FclCheck& check, const FclAnswers& of,
                   const std::vector<std::unique_ptr<Method>>& instances,
                   const std::vector<DrivenMethod>& methods, Search&& search) {
  const FclResult& theirs = of.theirs;
  FclFrame row;
  row.frame = of.frame;
  row.distance = theirs.distance;
  row.separated = theirs.separated;
  row.triangle_moving = theirs.triangle_moving;
  row.triangle_fixed = theirs.triangle_fixed;
  row.fixed_body = theirs.fixed_body;
  row.lmdbench_distance = of.exact;
  const bool we_separate = row.lmdbench_distance > 0.0;
  if (theirs.separated && we_separate)
    row.relative_difference = std::abs(theirs.distance - row.lmdbench_distance) / row.lmdbench_distance;
  row.agrees = theirs.separated == we_separate &&
               (!theirs.separated || row.relative_difference <= of.tolerance_relative);
  const auto note = [&](const std::string& who, double distance, bool is_error = false) {
    check.exceptions.push_back({of.frame, who, of.X_WM, distance, row.distance, row.lmdbench_distance,
                                row.triangle_moving, row.triangle_fixed, row.fixed_body, 0, is_error});
  };
  if (!row.agrees) note("lmdbench", row.lmdbench_distance);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    double difference = UNSET;
    const bool compared = theirs.separated && theirs.distance * (1.0 + of.tolerance_relative) < of.cutoff;
    const bool judged = instances[i]->description().promise == Promise::COMPLETE_SET &&
                        std::min(theirs.distance, of.exact) < of.cutoff;
    const double ours = compared || judged ? minimum_distance(search(i)) : UNSET;
    if (compared)
      difference = std::isnan(ours) ? std::numeric_limits<double>::infinity()
                                    : (ours - theirs.distance) / theirs.distance;
    const bool is_error = judged && contradicts_nearest(ours, of.nearest, of.cutoff, of.tolerance_relative);
    if (is_error || (compared && !(std::abs(difference) <= of.tolerance_relative)))
      note(methods[i].label, ours, is_error);
    row.method_difference.push_back(difference);
  }
  check.frames.push_back(std::move(row));
}

/// Not by the experiment's order of methods: the result must not depend on it.
void sort_exceptions(FclCheck& check) {
  std::sort(check.exceptions.begin(), check.exceptions.end(),
            [](const FclException& a, const FclException& b) {
              return std::tie(a.frame, a.who) < std::tie(b.frame, b.who);
            });
}

/// Names the bodies of several movers' exception as in files.
void file_exception(FclException& exception, const Scene& scene, const Pose& X_WM, const MoverPlay& play) {
  Lmd pair;
  pair.fixed_body = exception.fixed_body;
  pair.triangle_moving = exception.triangle_moving;
  pair.triangle_fixed = exception.triangle_fixed;
  const FiledLmd filed = as_filed(pair, scene, &play);
  exception.fixed_body = filed.lmd.fixed_body;
  exception.triangle_moving = filed.lmd.triangle_moving;
  exception.triangle_fixed = filed.lmd.triangle_fixed;
  exception.moving_body = filed.moving_body;
  const auto mover = std::ranges::find(play.number, static_cast<std::size_t>(filed.moving_body));
  exception.pose = filed.moving_body == 0 ? X_WM
                                          : play.poses[static_cast<std::size_t>(exception.frame)]
                                                      [static_cast<std::size_t>(mover - play.number.begin())];
}

}  // namespace

std::unique_ptr<FclCheck> probe_fcl(const Scene& scene, const DriverInput& input,
                                    const std::vector<DrivenMethod>& methods,
                                    const std::vector<std::int64_t>& frames, double tolerance_relative,
                                    const Progress& progress, const ProbeShortcuts& shortcuts) {
  SceneFrames bodies(scene, input.motion);
  std::vector<std::unique_ptr<Method>> instances;
  for (const DrivenMethod& method : methods) instances.push_back(method.make_for(bodies));

  // Deforming meshes get new FCL models in each frame: FCL's refit gives wrong distances for RSS
  // and OBBRSS, since RSS::operator+ makes a frame that is not orthonormal (FCL 0.7.0).
  std::optional<FclMinimum> fcl;
  ExactMinimum exact(bodies.scene(), shortcuts.warm && !bodies.deforms(), bodies.is_any());
  auto made = std::make_unique<FclCheck>();
  FclCheck& check = *made;
  const MoverPlay* play = input.motion.movers.get();
  check.several_move = play != nullptr;
  WorkCounters ignored;
  LmdSet lmds;
  std::size_t noted = 0;  // number before the last frame's
  for (const std::int64_t frame : frames) {
    const Pose& X_WM = input.poses[static_cast<std::size_t>(frame)];
    if (shortcuts.reuse_repeated && !bodies.is_any() && !check.frames.empty() &&
        same_pose(input.poses[static_cast<std::size_t>(check.frames.back().frame)], X_WM)) {
      check.frames.push_back(check.frames.back());
      check.frames.back().frame = frame;
      const std::vector<FclException> again(check.exceptions.begin() + static_cast<std::ptrdiff_t>(noted),
                                            check.exceptions.end());
      noted = check.exceptions.size();
      for (FclException exception : again) {
        exception.frame = frame;
        check.exceptions.push_back(std::move(exception));
      }
      tell_progress(progress, check.frames.size(), frames.size());
      continue;
    }
    noted = check.exceptions.size();
    bodies.to_frame(frame);
    if (!fcl || bodies.deforms()) fcl.emplace(bodies.scene());
    const FclResult theirs = fcl->at(X_WM);
    const NearestObjects::Nearest ours = exact.at(X_WM);
    const auto named = [&](const ObjectPair& pair, std::int32_t triangle_moving,
                           std::int32_t triangle_fixed) {
      const Scene& now = bodies.scene();
      return NamedTriangles{*now.body(pair.mover), *now.body(pair.other),
                            relative_pose(now.pose(pair.other, X_WM), now.pose(pair.mover, X_WM)),
                            triangle_moving, triangle_fixed};
    };
    const ObjectPair of_fcl = ObjectPair::of(theirs.fixed_body, bodies.scene());
    add_fcl_frame(check,
                  {frame,
                   X_WM,
                   theirs,
                   ours.distance,
                   {named(of_fcl, theirs.triangle_moving, theirs.triangle_fixed),
                    named(ours.objects, ours.triangle_moving, ours.triangle_fixed)},
                   scene.cutoff,
                   tolerance_relative},
                  instances, methods, [&](std::size_t i) -> const LmdSet& {
                    lmds.clear();
                    instances[i]->search(X_WM, lmds, ignored);
                    return lmds;
                  });
    tell_progress(progress, check.frames.size(), frames.size());
  }
  sort_exceptions(check);
  if (play != nullptr)
    for (FclException& exception : check.exceptions)
      file_exception(exception, scene, input.poses[static_cast<std::size_t>(exception.frame)], *play);
  return made;
}

namespace {

std::unique_ptr<ProbeFindings> cross_check(const ProbedTrack& track) {
  const double tolerance = track.choice.options["tolerance_relative"].get<double>();
  std::unique_ptr<FclCheck> found =
      probe_fcl(track.profile.scene, track.input, track.methods, track.frames, tolerance, track.progress,
                {.warm = is_on(track.rules, Rule::WARM_CROSSCHECK),
                 .reuse_repeated = is_on(track.rules, Rule::REPEATED_POSE)});
  found->tolerance_relative = tolerance;
  return found;
}

std::vector<ProbeDataset> fcl_datasets() {
  using Frame = const FclFrame&;
  using Row = const FclException&;
  std::vector<ProbeDataset> all;
  const auto frames = [](const FclCheck& check, std::size_t) -> const auto& {
    return check.frames;
  };
  const auto exceptions = [](const FclCheck& check, std::size_t) -> const auto& {
    return check.exceptions;
  };
  ProbeTable<FclCheck, FclFrame>("/crosscheck/fcl", "C", frames)
      .column("frame", "1", "frame that was cross-checked", [](Frame f) { return f.frame; })
      .column("distance", "m", "FCL's minimum distance", [](Frame f) { return f.distance; })
      .column("lmdbench_distance", "m", "exact minimum distance", [](Frame f) { return f.lmdbench_distance; })
      .column("relative_difference", "1", "difference of the two, relative to the exact one",
              [](Frame f) { return f.relative_difference; })
      .column("separated", "1", "1 where FCL finds no contact", [](Frame f) { return f.separated; })
      .column("agrees", "1", "1 where the two agree", [](Frame f) { return f.agrees; })
      .into(all);
  ProbeTable<FclCheck, FclException>("/crosscheck/fcl/exceptions", "E", exceptions,
                                     [](const FclCheck& check) { return check.several_move; })
      .column("moving_body", "1", "mover of FCL's nearest pair", [](Row e) { return e.moving_body; })
      .into(all);
  ProbeTable<FclCheck, FclException>("/crosscheck/fcl/exceptions", "E", exceptions)
      .column("who", "1", "label of the method, or lmdbench for the exact nearest pair",
              [](Row e) { return e.who; })
      .column("position", "m", "origin of the moving mesh's frame, world frame",
              [](Row e) { return e.pose.translation; })
      .column("orientation", "1", "unit quaternion x, y, z, w of the moving mesh",
              [](Row e) { return e.pose.rotation; })
      .column("frame", "1", "frame out of tolerance", [](Row e) { return e.frame; })
      .column("distance", "m", "their minimum distance", [](Row e) { return e.distance; })
      .column("fcl_distance", "m", "FCL's minimum distance", [](Row e) { return e.fcl_distance; })
      .column("lmdbench_distance", "m", "exact minimum distance", [](Row e) { return e.lmdbench_distance; })
      .column("triangle_moving", "1", "triangle of FCL's nearest pair",
              [](Row e) { return e.triangle_moving; })
      .column("triangle_fixed", "1", "triangle of FCL's nearest pair", [](Row e) { return e.triangle_fixed; })
      .column("fixed_body", "1", "fixed mesh of FCL's nearest pair", [](Row e) { return e.fixed_body; })
      .column("is_error", "1",
              "1 where a method that promises the complete set is wrong, whatever FCL's rounding",
              [](Row e) { return e.is_error; })
      .into(all);
  ProbeTable<FclCheck, FclFrame>("fcl", "C", frames)
      .column("frame", "1", "frame that was compared with FCL", [](Frame f) { return f.frame; })
      .column("minimum_distance_difference_relative", "1",
              "a fresh search's minimum distance minus FCL's, divided by FCL's; infinite where it found no "
              "pair",
              [](Frame f, std::size_t method) { return f.method_difference[method]; })
      .into(all);
  return all;
}

}  // namespace

std::vector<std::string> FclCheck::notes(const std::string& group) const {
  std::map<std::string, std::int64_t> counts;
  for (const FclException& exception : exceptions) ++counts[exception.who];
  std::vector<std::string> notes;
  for (const auto& [who, count] : counts)
    notes.push_back(fmt::format(
        "{}: minimum distance differs from FCL's in {} of {} frames, listed in {}/crosscheck/fcl/exceptions",
        who, count, frames.size(), group));
  return notes;
}

Probe fcl_probe() {
  return {.name = "fcl",
          .title = "FCL cross-check",
          .parent = "/probes",
          .first_stride_frames = FclCrosscheck::is_built_in() ? 50 : 0,
          .stride_text =
              "minimum distances are compared with FCL every this many frames; 0 switches the "
              "probe off",
          .options = {{"tolerance_relative",
                       {{"type", "number"},
                        {"exclusiveMinimum", 0},
                        {"default", 1e-6},
                        {"description", "largest relative difference that counts as agreement"}}}},
          .attributes = "/crosscheck/fcl",
          .datasets = fcl_datasets(),
          .why =
              [](const ProbeChoice& choice) {
                return fmt::format("minimum distances every {} frames, relative tolerance {:g}",
                                   choice.stride_frames, choice.options["tolerance_relative"].get<double>());
              },
          .left_out = "probes/fcl/stride_frames is 0: no FCL hierarchy is built",
          .refuse =
              [](const Experiment& /*experiment*/, const std::string& file, const std::string& place) {
                if (!FclCrosscheck::is_built_in())
                  throw missing_part(PART_FCL, file, place, "the cross-check");
              },
          .run = cross_check};
}

}  // namespace lmdbench
