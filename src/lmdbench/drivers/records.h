// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/pose_source.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/work_counters.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

/// Records of a run in memory. All but times is the same in every repetition and kept once.
namespace lmdbench {

inline constexpr double UNSET = std::numeric_limits<double>::quiet_NaN();

/// A haptic frame of one method, without its times.
struct FrameRecord {
  Vec3 force = Vec3::Zero();   ///< As rendered: after the device's clipping [N].
  Vec3 torque = Vec3::Zero();  ///< About the moving mesh's centre, before clipping [N m].
  bool force_clipped = false;
  bool force_above_continuous = false;         ///< More than the device's motors stand for long.
  std::int64_t lmd_count = 0;                  ///< LMDs within the cutoff.
  std::int64_t tracked_count = 0;              ///< LMDs of the set in use, also beyond the cutoff.
  double lmd_count_before_reduction = UNSET;   ///< Candidates of the search behind the set in use.
  double kept_after_reduction = UNSET;         ///< LMDs that its first reduction kept.
  double minimum_distance = UNSET;             ///< metres
  double lmd_age = UNSET;                      ///< Since the search of the set in use began [s].
  double effective_stiffness = 0.0;            ///< K_eff [N/m] before clipping.
  std::int64_t contact_without_direction = 0;  ///< LMDs without a direction of their own (E12).
  std::int64_t lmds_without_index = 0;         ///< If the aggregation needs indices.
  WorkCounters counters;                       ///< Of the frame's local part.
};

/// What one of several movers feels in a frame.
struct MoverFrame {
  Vec3 force = Vec3::Zero();   ///< As rendered: after the device's clipping [N].
  Vec3 torque = Vec3::Zero();  ///< About the mover's centre, before the device's clipping [N m].
  bool force_clipped = false;
  std::int64_t lmd_count = 0;       ///< LMDs of its pairs within the cutoff.
  double minimum_distance = UNSET;  ///< metres
};

/// A global search of one method, without its times.
struct SearchRecord {
  std::int64_t frame = 0;       ///< Frame that it started in.
  std::int64_t candidates = 0;  ///< LMDs that the search found.
  std::int64_t kept_after_reduction =
      0;                  ///< LMDs left by the first tracking (all of them where there is none).
  WorkCounters counters;  ///< Search and trackings in the global thread.
};

/// Times of one repetition [s]; NaN for what did not happen.
struct RepetitionTimes {
  std::vector<double> local_update;  ///< one a frame
  std::vector<double> following;     ///< Its part for deforming bodies, or empty.
  std::vector<double>
      way;  ///< Of a method from outside, beside local_update: transport, judging. Else empty.
  std::vector<double> global_search;  ///< one a search, as the next two
  std::vector<double> first_reduction;
  std::vector<double> second_tracking;
};

/// Rendered forces, one a frame under each law [N].
using ForcesByLaw = std::array<std::vector<Vec3>, FORCE_LAW_COUNT>;

/// All that one method left.
struct MethodRecord {
  std::string label;
  std::vector<FrameRecord> frames;
  std::vector<SearchRecord> searches;
  std::vector<RepetitionTimes> repetitions;  ///< The first one is the warm-up.
  std::map<std::int64_t, LmdSet> lmds;       ///< LMDs within the cutoff, of frames to be kept.
  /// Of several movers a row of them a frame, by number (mover_play.h); else empty. FrameRecord
  /// then has forces of the moving mesh, LMD counts and distances of all pairs.
  std::vector<MoverFrame> movers;
  /// Forces of its sets under each law, if these are the truth of every frame: of a method that
  /// promises the complete set and finds it anew. NaN where triangles intersect. Empty for others.
  ForcesByLaw force_by_law;
  std::vector<Pose>
      poses;  ///< Closed loop: X_WM of each frame, as the encoders told it. Empty in an open one.
  std::vector<LoopFrame> loop;    ///< Closed loop: the device in each frame. Empty in an open one.
  std::uint64_t result_hash = 0;  ///< Over frames' force bits and LMD features, in order.
  std::uint64_t work_hash = 0;    ///< Over all counters.
  std::int64_t other_repetitions =
      0;  ///< Of a method from outside: repetitions that left other hashes than the first one.
};

}  // namespace lmdbench
