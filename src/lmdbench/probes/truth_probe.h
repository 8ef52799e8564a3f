// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/probes/probed_track.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// The truth probe: on a stride of frames the exhaustive LMD set is computed at the frame and at the next
/// one, outside the timed frames, and every method is compared with it. Force errors compare rendered forces
/// (clipped by the same device) under the method's own law, so that they show what the LMD set costs and not
/// what the law changes. The aggregation is the profile's, also for a method whose LMDs can only be summed. Where the meshes touch, a true LMD at distance 0 has no direction and adds no force,
/// while a method in motion keeps its last direction (E12): the force errors of such frames say little.
namespace lmdbench {

/// Truth at one frame.
struct TruthFrame {
  std::int64_t frame = 0;
  LmdSet lmds;
  std::array<Vec3, FORCE_LAW_COUNT> force = no_forces();  ///< Rendered, under each law [N].
  /// On the moving mesh before the device clips it, under each law [N m]; of `truth_frames` alone.
  std::array<Vec3, FORCE_LAW_COUNT> torque = no_forces();
  std::array<double, FORCE_LAW_COUNT> force_jump{};  ///< |force at the next frame - force| [N].
  ForcesByLaw movers;  ///< Where several meshes move: of each by its number, the moving mesh first [N].

  static std::array<Vec3, FORCE_LAW_COUNT> no_forces() {
    std::array<Vec3, FORCE_LAW_COUNT> forces;
    forces.fill(Vec3::Zero());
    return forces;
  }
};

/// One method against one TruthFrame. NaN where a quantity does not exist.
struct TruthComparison {
  Agreement same;                         ///< Same features.
  Agreement neighbours;                   ///< Neighbouring features count.
  double minimum_distance_error = UNSET;  ///< Method's minus true [m]; NaN unless both see an LMD.
  double force_error = UNSET;             ///< Length of the difference [N].
  double force_angle_error = UNSET;       ///< Angle between the forces [rad]; NaN where one vanishes.
  double force_jump = UNSET;              ///< The method's own |force at the next frame - force| [N].
};

/// The truth of every frame, where a method that finds the complete set in every frame ran along: what changes from a frame to
/// the next is rare, and a probe on a stride sees hardly any of it. The probe's exhaustive sets, which share no search code with
/// the method, say whether its sets stand.
struct CompleteTruth {
  std::string label;  ///< Of the method.
  ForcesByLaw force;  ///< Rendered, one a frame under each law [N].
  std::vector<std::int64_t> lmd_count;
};

/// A method's record and what the probe found of it.
struct ProbedRecord {
  const MethodRecord* record = nullptr;
  const std::vector<TruthComparison>* probed = nullptr;
};

/// The first by label of the methods that kept forces under both laws (MethodRecord::force_by_law), if the probe looked at some
/// frames and its set was the exhaustive one in all of them.
/// @param candidates methods that share poses and profile
std::optional<CompleteTruth> complete_truth(std::vector<ProbedRecord> candidates);

/// What the probe `truth` finds along a track.
struct TruthFindings : ProbeFindings {
  std::vector<TruthFrame> frames;
  std::vector<std::vector<TruthComparison>>
      comparisons;                        ///< One list a method of the track, one entry a frame.
  std::optional<CompleteTruth> complete;  ///< Where a method of the track gives it.
  std::vector<std::string> doubts;        ///< Of methods that promise the complete set.

  std::vector<std::string> notes(const std::string& /*group*/) const override { return doubts; }
};

/// Angle between two forces [rad]; NaN where one of them vanishes.
double force_angle(const Vec3& a, const Vec3& b);

/// Truth at the given frames, with the jump of the force to each one's next.
/// @param truth_at set and rendered forces of a frame
/// @throws Interrupted when `progress` asked to stop
std::vector<TruthFrame> truth_of_frames(const std::vector<std::int64_t>& frames,
                                        const std::function<TruthFrame(std::int64_t frame)>& truth_at,
                                        const Progress& progress);

/// Computes truth at the given frames.
/// @param profile  the scene's; its law is ignored
/// @param aggregation  makes the true forces of the exhaustive sets
/// @param in_contact  one a frame, where frames out of contact are known to have an empty set; else null
/// @param reuse_repeated  whether a frame at the pose of the one searched before it has its set without a search
/// @param progress may stop the probe by returning false, which throws Interrupted
std::vector<TruthFrame> probe_truth(const Scene& scene, const DriverInput& input, const ForceProfile& profile,
                                    const Aggregation& aggregation, const std::vector<std::int64_t>& frames,
                                    const Progress& progress, const std::vector<bool>* in_contact = nullptr,
                                    bool reuse_repeated = true);

/// @pre the record keeps the LMD sets of the truth's frames
std::vector<TruthComparison> compare_with_truth(const std::vector<TruthFrame>& truth,
                                                const MethodRecord& record, ForceLaw law, const Scene& scene);

/// Truth in every frame. A probe on a stride sees every tenth event: rare jumps of the true force are missed and the
/// methods look worse, or better, than they are. `certified` gives the true set in microseconds; `exhaustive`, which
/// shares no search code with it, is asked at some frames whether that stands in this scene, too.

struct TrueSets {
  std::vector<LmdSet> sets;  ///< One a frame, as is
  std::array<std::vector<Wrench>, FORCE_LAW_COUNT>
      wrenches;                     ///< what the moving mesh feels of it under each law.
  std::int64_t checked_frames = 0;  ///< Compared with the exhaustive set.
  std::int64_t wrong_frames = 0;    ///< Of these, with another set of feature pairs.
};

/// @param checks   frames to compare with the exhaustive set, evenly spread; all where there are fewer
/// @param progress may stop by returning false, which throws Interrupted
TrueSets true_sets(const PreparedRun& run, std::int64_t checks, const Progress& progress);

/// The true forces of the sets at the frames from `first` on that have a next one.
/// @param run whose profile and device render
std::vector<TruthFrame> truth_frames(const TrueSets& truth, const PreparedRun& run, std::int64_t first);

}  // namespace lmdbench
