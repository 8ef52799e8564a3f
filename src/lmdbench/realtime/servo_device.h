// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/held_mesh.h>
#include <lmdbench/drivers/pose_source.h>
#include <lmdbench/experiment/loop_choice.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/phantom/virtual_phantom.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// A device for the servo loop: its thread calls both once a tick; they must not allocate or lock.
class ServoDevice {
 public:
  virtual ~ServoDevice() = default;

  /// X_WM by the encoders, now.
  /// @param period  servo period, counted from the start of the run
  /// @param now     [ns]
  virtual const Pose& sense(std::int64_t period, std::int64_t now) = 0;

  /// The motors' output from now on.
  virtual void render(const RenderedForce& rendered, std::int64_t now) = 0;

  /// The device's motion up to the last `sense` and the force that it holds since the last
  /// `render`; nullptr if unknown.
  virtual const LoopFrame* moved() const { return nullptr; }
};

/// A recorded device: poses of a path, one a servo period. Forces do not move it.
class RecordedDevice final : public ServoDevice {
 public:
  /// @param path must outlive this
  explicit RecordedDevice(const std::vector<Pose>& path) : path_(path) {}

  const Pose& sense(std::int64_t period, std::int64_t now) override;
  void render(const RenderedForce& rendered, std::int64_t now) override;

 private:
  const std::vector<Pose>& path_;
};

/// The simulated PHANTOM in real time: the force that is held at each instant moves it, in steps of
/// a fraction of a servo period. A late tick senses where it is by then, a late force acts late,
/// and without a tick the last force goes on.
class SimulatedServoDevice final : public ServoDevice {
 public:
  /// @param path   the intended path, one pose a servo period
  /// @param start  instant of the path's first pose [ns]
  /// @param period servo period [ns]
  /// @param steps  of the simulation in a servo period
  /// @param calls_a_period forces rendered in a servo period; more than one of a device that calls
  ///               faster
  SimulatedServoDevice(const LoopChoice& loop, const std::vector<Pose>& path, std::int64_t start,
                       std::int64_t period, std::int64_t steps, double calls_a_period,
                       const Vec3& reference_M);

  const Pose& sense(std::int64_t period, std::int64_t now) override;
  void render(const RenderedForce& rendered, std::int64_t now) override;
  const LoopFrame* moved() const override { return &frame_; }

 private:
  struct Due {
    std::int64_t at = 0;
    RenderedForce rendered;
  };
  /// Whether the force is held in the step that begins at `now`: to the nearest step.
  bool is_due(const Due& due, std::int64_t now) const;
  void hold_next();
  void advance_to(std::int64_t now);
  Pose path_at(std::int64_t step) const;

  const std::vector<Pose>& path_;
  std::int64_t start_, step_ns_, steps_, delay_ns_;
  HeldMesh mesh_;
  std::int64_t step_ = 0;  ///< Steps done.
  std::vector<Due> due_;   ///< Ring of forces not yet held.
  std::size_t first_due_ = 0, due_count_ = 0;
  RenderedForce held_;
  LoopFrame frame_;
  Pose pose_;
};

}  // namespace lmdbench
