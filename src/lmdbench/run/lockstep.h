// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/phantom/virtual_phantom.h>
#include <lmdbench/run/pose_source.h>
#include <lmdbench/run/records.h>
#include <lmdbench/run/scene_frames.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The lockstep driver: one clock instead of threads, so that results depend on the scene alone, while the
/// staleness that threads would cause is an explicit number of frames. A frame does what the paper's threads
/// would (sections 4.3 and 5):
///  0. What else moves goes to this frame's place. Where meshes deform the method's own bodies get this frame's vertices, and what was
///     prepared of them follows: a part of the frame's local update, whose share of it is kept apart as well.
///  1. A search whose latency is over arrives: its set is tracked to this frame's pose (second tracking) and
///     replaces the working set.
///  2. Every `search_every_frames` a global search starts at this frame's pose, followed by the first
///     tracking (reduction) at the same pose. With a latency of 0 it arrives at once.
///  3. The local part tracks the working set to this frame's pose.
///  4. LMDs within the cutoff are summed into a force, which the device clips.
///  5. In a closed loop the device moves until the next frame, whose pose is the device's.
/// Methods without local tracking search in every frame instead.
namespace lmdbench {

/// A method under test: how to make a fresh instance, and its force profile.
struct LockstepMethod {
  std::string label;
  std::function<std::unique_ptr<Method>()> make;
  ForceProfile profile;
  /// What becomes of its LMDs; needs a method that finds critical pairs where it is not their sum.
  const Aggregation* aggregation = &sum_law();
  Scene scene = {};  ///< For aggregations that need more than the method's set.
  /// Makes it on another scene of the same meshes: where some deform or several move, each run of a method has a scene of its own.
  std::function<std::unique_ptr<Method>(const Scene& scene)> make_on = nullptr;

  std::unique_ptr<Method> make_for(const SceneFrames& frames) const {
    return frames.is_any() ? make_on(frames.scene()) : make();
  }
};

/// All that the driver needs to know of the scene.
struct LockstepInput {
  std::vector<Pose>
      poses;  ///< The path, one a frame, X_WM; in a closed loop the one that the hand means to take.
  double frame_rate_hz = 1000.0;
  /// Makes the source of a method's poses; unset: the path itself.
  std::function<std::unique_ptr<PoseSource>()> make_poses = nullptr;
  std::optional<std::int64_t> frames = std::nullopt;  ///< Unset: as many as the path has poses.
  Vec3 reference_M = Vec3::Zero();  ///< Point of the moving mesh about which torque is taken.
  VirtualPhantom device;
  std::function<bool(std::int64_t frame)> keep_lmds;  ///< Frames whose LMD sets are to be kept.
  SceneMotion motion = {};  ///< Where there is any every method needs `make_on` and a scene.
};

/// Called after every block, and between slow frames, with frames done and frames to do, over all methods and
/// repetitions; false stops the run.
using Progress = std::function<bool(std::int64_t done, std::int64_t total)>;

/// Thrown when `Progress` asked to stop.
class Interrupted {};

/// Says how far a loop is, where anybody asks.
/// @throws Interrupted when `progress` asked to stop
inline void tell_progress(const Progress& progress, std::size_t done, std::size_t total) {
  if (progress && !progress(static_cast<std::int64_t>(done), static_cast<std::int64_t>(total)))
    throw Interrupted();
}

class RunKeeper;

/// Runs every method along all poses (in a closed loop: each on a device of its own), `repetitions` times. Methods take turns block by block, in random
/// order, so that drifts of the machine's speed and what another method leaves in the caches hit all alike; every repetition starts from fresh instances.
/// @param keeper keeps every frame as it is measured and knows those of an interrupted run; may be nullptr
/// @throws Error with ExitCode::INTERNAL when a repetition's forces, LMDs or counters differ from the
///         first one's
std::vector<MethodRecord> run_lockstep(const std::vector<LockstepMethod>& methods, const LockstepInput& input,
                                       const DriverChoice& driver, const Progress& progress,
                                       RunKeeper* keeper = nullptr);

}  // namespace lmdbench
