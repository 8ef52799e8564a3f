// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/loop_choice.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/phantom/virtual_phantom.h>
#include <lmdbench/prepare/scene_frames.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Inputs of every driver: methods, and the scene that they run on.
namespace lmdbench {

class PoseSource;

/// A method under test: how to make a fresh instance, and its force profile.
struct DrivenMethod {
  std::string label;
  std::function<std::unique_ptr<Method>()> make;
  ForceProfile profile;
  /// How its LMDs combine; other than the sum needs a method that finds critical pairs.
  const Aggregation* aggregation = &sum_law();
  Scene scene = {};  ///< For aggregations that need more than the method's set.
  /// Makes it on another scene of the same meshes: for runs whose meshes deform or several move.
  std::function<std::unique_ptr<Method>(const Scene& scene)> make_on = nullptr;

  std::unique_ptr<Method> make_for(const SceneFrames& frames) const {
    return frames.is_any() ? make_on(frames.scene()) : make();
  }
};

/// Scene, path and device for a driver.
struct DriverInput {
  /// X_WM, one a frame: the path; in a closed loop the path that the hand intends.
  std::vector<Pose> poses = {};
  double frame_rate_hz = 1000.0;
  LoopChoice loop = {};  ///< Closed: every method moves a device of its own.
  /// Makes the source of a method's poses if that is neither the path nor the loop's device.
  std::function<std::unique_ptr<PoseSource>()> make_poses = nullptr;
  std::optional<std::int64_t> frames = std::nullopt;  ///< Unset: one for each pose of the path.
  Vec3 reference_M = Vec3::Zero();  ///< Point of the moving mesh about which torque is taken.
  VirtualPhantom device;
  std::function<bool(std::int64_t frame)> keep_lmds = nullptr;  ///< Frames whose LMD sets are kept.
  SceneMotion motion = {};  ///< If any, all methods need `make_on` and a scene.
};

}  // namespace lmdbench
