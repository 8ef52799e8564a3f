// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/held_mesh.h>
#include <lmdbench/experiment/loop_choice.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/phantom/virtual_phantom.h>
#include <lmdbench/prepare/driver_input.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace lmdbench {

/// What the simulated device did in one frame, beside the pose that it told.
struct LoopFrame {
  Vec3 position = Vec3::Zero();  ///< True, of the mesh's origin at the frame's tick, world [m].
  Vec3 velocity = Vec3::Zero();  ///< Of that point at the tick [m/s].
  RenderedForce held;            ///< Until the next tick: rendered `delay_frames` frames ago.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< True, at the tick.
  Vec3 angular_velocity = Vec3::Zero();                             ///< With six degrees [rad/s].
  EnergyAccount energy;                                             ///< Since the start.
};

/// Poses of a method, frame by frame: of a path, or of a device that rendered forces move.
class PoseSource {
 public:
  virtual ~PoseSource() = default;

  /// X_WM of the present frame.
  virtual const Pose& pose() const = 0;

  /// Renders the present frame's force and goes on to the next frame.
  /// @return what the device did, in a closed loop
  virtual std::optional<LoopFrame> render(const RenderedForce& rendered) = 0;
};

/// Poses of a path: the open loop.
class PathPoses final : public PoseSource {
 public:
  /// @param path one pose a frame; must outlive this
  explicit PathPoses(const std::vector<Pose>& path) : path_(path) {}

  const Pose& pose() const override { return path_[frame_]; }
  std::optional<LoopFrame> render(const RenderedForce& rendered) override;

 private:
  const std::vector<Pose>& path_;
  std::size_t frame_ = 0;
};

/// Poses of a simulated device (closed loop), as its encoders tell; at rest at the path's start.
class DevicePoses final : public PoseSource {
 public:
  /// @param path         the meant path, one pose a frame
  /// @param period       servo period [s]
  /// @param reference_M  point about which torque is taken
  DevicePoses(const LoopChoice& loop, std::vector<Pose> path, double period,
              const Vec3& reference_M = Vec3::Zero());

  const Pose& pose() const override { return pose_; }
  std::optional<LoopFrame> render(const RenderedForce& rendered) override;

 private:
  std::vector<Pose> path_;
  HeldMesh mesh_;
  std::deque<RenderedForce> under_way_;  ///< What is not rendered yet, oldest first.
  std::size_t frame_ = 0;
  Pose pose_;
};

/// Of one method in one repetition.
/// @param input must outlive it
std::unique_ptr<PoseSource> pose_source(const DriverInput& input);

}  // namespace lmdbench
