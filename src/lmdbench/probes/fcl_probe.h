// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>
#include <lmdbench/probes/probed_track.h>

#include <cstdint>
#include <string>
#include <vector>

/// The FCL cross-check: on a stride of frames it compares FCL's minimum distance, the exact nearest
/// pair of lmdbench and the minimum of each method's fresh search (age 0). Distances are compared
/// only while the meshes are separated; in contact only the yes or no. A disagreement is a question
/// for arbitration. But a method that promises the complete set fails the run, in contact too, if
/// the exact kernel contradicts it at FCL's or the exact search's triangles (nearest_judge.h).
namespace lmdbench {

struct FclFrame {
  std::int64_t frame = 0;
  double distance = UNSET;             ///< FCL [m]; 0 in contact.
  double lmdbench_distance = UNSET;    ///< Exact nearest pair [m].
  double relative_difference = UNSET;  ///< |FCL - exact| / exact; NaN unless both are separated.
  bool separated = false;              ///< According to FCL.
  bool agrees = false;                 ///< Within the tolerance, or both in contact.
  /// One a method: (method - FCL) / FCL; NaN in contact or beyond the cutoff; infinite
  /// where the method found no pair.
  std::vector<double> method_difference;
  std::int32_t triangle_moving = -1;  ///< FCL's nearest pair, for arbitration.
  std::int32_t triangle_fixed = -1;
  std::int32_t fixed_body = -1;
};

/// A comparison out of tolerance.
struct FclException {
  std::int64_t frame = 0;
  std::string who;          ///< Method's label, or "lmdbench" for the exact pair.
  Pose pose;                ///< X_WM, to paste back into a test.
  double distance = UNSET;  ///< Its distance [m].
  double fcl_distance = UNSET;
  double lmdbench_distance = UNSET;
  std::int32_t triangle_moving = -1;  ///< FCL's nearest pair.
  std::int32_t triangle_fixed = -1;
  std::int32_t fixed_body = -1;
  std::int64_t moving_body = 0;  ///< Of several movers: the one with this pose.
  bool is_error = false;         ///< Of a complete method: contradicts_nearest.
};

struct FclCheck : ProbeFindings {
  std::vector<FclFrame> frames;
  std::vector<FclException> exceptions;
  double tolerance_relative = 0.0;
  bool several_move = false;

  std::vector<std::string> notes(const std::string& group) const override;
};

/// Savings that leave the answers the same.
struct ProbeShortcuts {
  bool warm = true;            ///< Starts from the last frame's nearest triangles.
  bool reuse_repeated = true;  ///< A repeated pose has the last frame's answers.
};

/// @throws Interrupted when `progress` asks to stop
std::unique_ptr<FclCheck> probe_fcl(const Scene& scene, const DriverInput& input,
                                    const std::vector<DrivenMethod>& methods,
                                    const std::vector<std::int64_t>& frames, double tolerance_relative,
                                    const Progress& progress, const ProbeShortcuts& shortcuts = {});

}  // namespace lmdbench
