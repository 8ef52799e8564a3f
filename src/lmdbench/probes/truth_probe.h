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
#include <optional>
#include <string>
#include <vector>

/// The truth probe: on a stride of frames the exhaustive LMD set is computed at the frame and the
/// next, outside the timed frames, and every method is compared with it. Force errors compare
/// rendered forces (clipped by the same device) under the method's own law: they show the effect of
/// the LMD set, not of the law. The aggregation is the profile's, also for a method whose LMDs can
/// only be summed. Where triangles intersect, a true LMD has no direction, and no force is the true
/// one: forces, torques and errors of that frame are NaN.
namespace lmdbench {

/// Truth at one frame. Forces are NaN where none is the true one.
struct TruthFrame {
  std::int64_t frame = 0;
  LmdSet lmds;
  std::array<Vec3, FORCE_LAW_COUNT> force = no_forces();  ///< Rendered, under each law [N].
  /// Torque on the moving mesh before clipping, under each law [N m].
  std::array<Vec3, FORCE_LAW_COUNT> torque = no_forces();
  /// |force at the next frame - force| [N].
  std::array<double, FORCE_LAW_COUNT> force_jump{};
  ForcesByLaw movers;  ///< Of movers, the moving mesh first [N].

  /// LMDs of triangles that intersect: with one of them no force is the true one.
  std::int64_t contact_without_direction() const;

  static std::array<Vec3, FORCE_LAW_COUNT> no_forces() {
    std::array<Vec3, FORCE_LAW_COUNT> forces;
    forces.fill(Vec3::Zero());
    return forces;
  }
};

/// One method against one TruthFrame. NaN where a quantity does not exist.
struct TruthComparison {
  Agreement same;                         ///< Counts the same features; empty of other meshes.
  Agreement neighbours;                   ///< Neighbouring features count, too.
  double minimum_distance_error = UNSET;  ///< Method's minus true [m]; NaN without both.
  double force_error = UNSET;             ///< Length of the difference [N].
  double force_angle_error = UNSET;       ///< Between the forces [rad]; NaN if one vanishes.
  double force_jump = UNSET;              ///< Of the method [N], as in TruthFrame.
};

/// The truth of every frame, if a method that finds the complete set in every frame was run:
/// changes between frames are rare, and a probe on a stride misses most. The probe's exhaustive
/// sets, which share no search code with the method, check its sets.
struct CompleteTruth {
  std::string label;  ///< Of the method.
  /// Rendered, one a frame under each law [N]; NaN where triangles intersect.
  ForcesByLaw force;
  std::vector<std::int64_t> lmd_count;
};

/// A method's record and the probe's findings about it.
struct ProbedRecord {
  const MethodRecord* record = nullptr;
  const std::vector<TruthComparison>* probed = nullptr;
};

/// From the first method by label that kept forces under both laws (MethodRecord::force_by_law), if
/// the probe looked at some frames and its set was exhaustive's in all of them.
/// @param candidates methods that share poses and profile
std::optional<CompleteTruth> complete_truth(std::vector<ProbedRecord> candidates);

/// Findings of the probe `truth` along a track.
struct TruthFindings : ProbeFindings {
  std::vector<TruthFrame> frames;
  std::vector<std::vector<TruthComparison>> comparisons;  ///< One list a method, one entry a frame.
  std::optional<CompleteTruth> complete;                  ///< If a method of the track gives it.
  std::vector<std::string> doubts;                        ///< Of methods that promise all LMDs.

  std::vector<std::string> notes(const std::string& /*group*/) const override { return doubts; }
};

/// Angle between two forces [rad]; NaN where one of them vanishes.
double force_angle(const Vec3& a, const Vec3& b);

/// Computes truth at the given frames, with the force's jump to the next frame.
/// @param profile  of the scene; its law is ignored
/// @param aggregation  makes the true forces from the exhaustive sets
/// @param in_contact  one a frame, if frames out of contact need no search (empty sets); or null
/// @param reuse_repeated  whether a frame at the last searched pose takes that set
/// @param progress may return false to stop the probe, which throws Interrupted
std::vector<TruthFrame> probe_truth(const Scene& scene, const DriverInput& input, const ForceProfile& profile,
                                    const Aggregation& aggregation, const std::vector<std::int64_t>& frames,
                                    const Progress& progress, const std::vector<bool>* in_contact = nullptr,
                                    bool reuse_repeated = true);

/// @param scene  of both; null where truth is of other meshes, whose features are not the method's
/// @pre the record has the LMD sets of the truth's frames
std::vector<TruthComparison> compare_with_truth(const std::vector<TruthFrame>& truth,
                                                const MethodRecord& record, ForceLaw law, const Scene* scene);

/// Truth in every frame. A probe on a stride sees every tenth event, so methods look worse, or
/// better, than they are. `certified` gives the true set in microseconds; `exhaustive`, which
/// shares no search code with it, checks some frames of this scene.
struct TrueSets {
  std::vector<TruthFrame> frames;   ///< All; the last one has no jump.
  std::int64_t checked_frames = 0;  ///< Compared with the exhaustive set.
  std::int64_t wrong_frames = 0;    ///< Those with another set of feature pairs.
};

/// @param checks   frames to compare with the exhaustive set, evenly spread, or all
/// @param progress may return false to stop, which throws Interrupted
TrueSets true_sets(const PreparedRun& run, std::int64_t checks, const Progress& progress);

}  // namespace lmdbench
