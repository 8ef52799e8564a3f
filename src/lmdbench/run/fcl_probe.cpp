// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/run/fcl_probe.h>
#include <lmdbench/run/mover_probe.h>
#include <lmdbench/run/nearest_judge.h>
#include <lmdbench/run/nearest_opinions.h>

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

/// What is known of a frame.
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
                   const std::vector<LockstepMethod>& methods, Search&& search) {
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

/// Not in the order in which the experiment lists its methods: the result must not depend on it.
void sort_exceptions(FclCheck& check) {
  std::sort(check.exceptions.begin(), check.exceptions.end(),
            [](const FclException& a, const FclException& b) {
              return std::tie(a.frame, a.who) < std::tie(b.frame, b.who);
            });
}

}  // namespace

std::unique_ptr<FclCheck> probe_fcl(const Scene& scene, const LockstepInput& input,
                                    const std::vector<LockstepMethod>& methods,
                                    const std::vector<std::int64_t>& frames, double tolerance_relative,
                                    const Progress& progress, const ProbeShortcuts& shortcuts) {
  DeformingScene bodies(scene, input.deformation);
  std::vector<std::unique_ptr<Method>> instances;
  for (const LockstepMethod& method : methods) instances.push_back(method.make_for(bodies));

  // Where meshes deform FCL's models are built anew in each frame: its refit from the leaves up gives wrong distances for RSS and
  // OBBRSS, since RSS::operator+ takes one axis of the sum from an operand, so that its frame is not orthonormal (FCL 0.7.0).
  std::optional<FclMinimum> fcl;
  ExactMinimum exact(bodies.scene(), shortcuts.warm && !bodies.deforms());
  auto made = std::make_unique<FclCheck>();
  FclCheck& check = *made;
  WorkCounters ignored;
  LmdSet lmds;
  std::size_t noted = 0;  // exceptions before those of the last frame
  for (const std::int64_t frame : frames) {
    const Pose& X_WM = input.poses[static_cast<std::size_t>(frame)];
    if (shortcuts.reuse_repeated && !bodies.deforms() && !check.frames.empty() &&
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
    const NearestInstance ours = exact.at(X_WM);
    const auto named = [&](std::int32_t fixed_body, std::int32_t triangle_moving,
                           std::int32_t triangle_fixed) {
      const FixedBody& fixed = bodies.scene().fixed[static_cast<std::size_t>(std::max(fixed_body, 0))];
      const Pose X_FM = fixed.is_placed() ? relative_pose(fixed.X_WF, X_WM) : X_WM;
      return NamedTriangles{*bodies.scene().moving, *fixed, X_FM, triangle_moving, triangle_fixed};
    };
    add_fcl_frame(check,
                  {frame,
                   X_WM,
                   theirs,
                   ours.distance,
                   {named(theirs.fixed_body, theirs.triangle_moving, theirs.triangle_fixed),
                    named(ours.instance, ours.triangle_moving, ours.triangle_fixed)},
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
  return made;
}

namespace {

/// Names the bodies of an exception of several movers as files do.
void file_exception(FclException& exception, const MoverPlay& play) {
  Lmd pair;
  pair.fixed_body = exception.fixed_body;
  pair.triangle_moving = exception.triangle_moving;
  pair.triangle_fixed = exception.triangle_fixed;
  const FiledLmd filed = as_filed(pair, play);
  exception.fixed_body = filed.lmd.fixed_body;
  exception.triangle_moving = filed.lmd.triangle_moving;
  exception.triangle_fixed = filed.lmd.triangle_fixed;
  exception.moving_body = filed.moving_body;
  const auto mover = std::ranges::find(play.number, static_cast<std::size_t>(filed.moving_body));
  exception.pose = play.poses[static_cast<std::size_t>(exception.frame)]
                             [static_cast<std::size_t>(mover - play.number.begin())];
}

/// As of one mover, the distances those of the nearest two objects.
std::unique_ptr<FclCheck> probe_mover_fcl(const MoverPlay& play, double cutoff,
                                          const std::vector<LockstepMethod>& methods,
                                          const std::vector<std::int64_t>& frames, double tolerance_relative,
                                          const Progress& progress) {
  const MoverScene scene = play.scene(cutoff);
  const auto poses = std::make_shared<std::vector<Pose>>();
  std::vector<std::unique_ptr<Method>> instances;
  for (const LockstepMethod& method : methods) instances.push_back(method.make_among(scene, poses));
  MoverFclMinimum fcl(play);
  MoverDistances exact(play);
  auto made = std::make_unique<FclCheck>();
  FclCheck& check = *made;
  check.several_move = true;
  WorkCounters ignored;
  LmdSet lmds;
  for (const std::int64_t frame : frames) {
    const auto at = static_cast<std::size_t>(frame);
    *poses = play.poses[at];
    const FclResult theirs = fcl.at(at);
    const Pose& X_WM = (*poses)[ObjectPair::of(theirs.fixed_body, play.object_count()).mover];
    const MoverDistances::Nearest ours = exact.at(at);
    const auto named = [&](const ObjectPair& objects, std::int32_t triangle_moving,
                           std::int32_t triangle_fixed) {
      return NamedTriangles{*scene.movers[objects.mover], *scene.body(objects.other),
                            relative_pose(scene.pose(objects.other, *poses), (*poses)[objects.mover]),
                            triangle_moving, triangle_fixed};
    };
    add_fcl_frame(check,
                  {frame,
                   X_WM,
                   theirs,
                   ours.distance,
                   {named(ObjectPair::of(theirs.fixed_body, play.object_count()), theirs.triangle_moving,
                          theirs.triangle_fixed),
                    named(ours.objects, ours.triangle_moving, ours.triangle_fixed)},
                   cutoff,
                   tolerance_relative},
                  instances, methods, [&](std::size_t i) -> const LmdSet& {
                    lmds.clear();
                    instances[i]->search(X_WM, lmds, ignored);
                    return lmds;
                  });
    tell_progress(progress, check.frames.size(), frames.size());
  }
  sort_exceptions(check);
  for (FclException& exception : check.exceptions) file_exception(exception, play);
  return made;
}

std::unique_ptr<ProbeFindings> cross_check(const ProbedTrack& track) {
  const double tolerance = track.choice.options["tolerance_relative"].get<double>();
  std::unique_ptr<FclCheck> found =
      track.input.movers ? probe_mover_fcl(*track.input.movers, track.profile.scene.cutoff, track.methods,
                                           track.frames, tolerance, track.progress)
                         : probe_fcl(track.profile.scene, track.input, track.methods, track.frames, tolerance,
                                     track.progress,
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
