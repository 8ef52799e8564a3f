// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/loop_choice.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/phantom/simulated_device.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace lmdbench {

/// What the simulated device did in one frame, beside the pose that it told.
struct LoopFrame {
  Vec3 position = Vec3::Zero();  ///< True position at the frame's tick, world [m].
  Vec3 velocity = Vec3::Zero();  ///< At the tick [m/s].
  Vec3 held_force =
      Vec3::Zero();      ///< Held from this tick to the next: the force of `delay_frames` frames ago [N].
  EnergyAccount energy;  ///< Since the start, at the tick.
};

/// Where one method's poses come from, frame by frame. A path does not care what is rendered; a closed loop does.
class PoseSource {
 public:
  virtual ~PoseSource() = default;

  /// X_WM of the present frame.
  virtual const Pose& pose() const = 0;

  /// Renders the present frame's force [N] and goes on to the next frame.
  /// @return what the device did, in a closed loop
  virtual std::optional<LoopFrame> render(const Vec3& force_W) = 0;
};

/// Poses of a path: the open loop.
class PathPoses final : public PoseSource {
 public:
  /// @param path one pose a frame; must outlive this
  explicit PathPoses(const std::vector<Pose>& path) : path_(path) {}

  const Pose& pose() const override { return path_[frame_]; }
  std::optional<LoopFrame> render(const Vec3& force_W) override;

 private:
  const std::vector<Pose>& path_;
  std::size_t frame_ = 0;
};

/// Poses of a simulated device: the closed loop. It starts at rest where the path starts. Its position is what its encoders
/// tell, its orientation the path's (three actuated degrees of freedom: nothing resists a turn).
class DevicePoses final : public PoseSource {
 public:
  /// @param path   the meant path, one pose a frame
  /// @param period servo period [s]
  DevicePoses(const LoopChoice& loop, std::vector<Pose> path, double period);

  const Pose& pose() const override { return pose_; }
  std::optional<LoopFrame> render(const Vec3& force_W) override;

 private:
  void sense();

  std::vector<Pose> path_;
  SimulatedDevice device_;
  std::deque<Vec3> under_way_;  ///< Forces that are not rendered yet, oldest first.
  std::size_t frame_ = 0;
  Pose pose_;
};

}  // namespace lmdbench
