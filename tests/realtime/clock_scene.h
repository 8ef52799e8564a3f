// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/realtime/driver.h>

#include <support/scenes.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

/// Small scenes for runs on the clock. No test needs a tick in time: test machines may be busy.
namespace lmdbench::testing {

/// A method with one LMD at the pose's x coordinate; it first runs the work that a test gives it.
class ClockMethod : public Method {
 public:
  using Plant = std::function<void()>;

  explicit ClockMethod(bool tracks, Plant in_search = {}) : in_search_(std::move(in_search)) {
    description_.name = "clock";
    description_.tracks_locally = tracks;
    description_.trackings_after_search = tracks ? 2 : 0;
  }
  const MethodDescription& description() const override { return description_; }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    if (in_search_) in_search_();
    lmds.resize(1);
    track(X_WM, lmds, counters);
  }
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters&) override {
    for (Lmd& lmd : lmds) {
      lmd.distance = X_WM.translation.x();
      lmd.direction = Vec3::UnitZ();
      lmd.point_moving = X_WM.translation;
      lmd.point_fixed = lmd.point_moving + lmd.distance * lmd.direction;
      lmd.feature_moving = {FeatureKind::VERTEX, 0};
      lmd.feature_fixed = {FeatureKind::FACE, 0};
    }
  }

 private:
  Plant in_search_;
  MethodDescription description_;
};

inline DrivenMethod clock_method(bool tracks, ClockMethod::Plant in_search = {}) {
  return {"clock", [=] { return std::make_unique<ClockMethod>(tracks, in_search); },
          ForceProfile{ForceLaw::LINEAR, 1.0, 0.0, 1.0, 4.0}};
}

/// A path along x from 0.1 m at a millimetre a second.
inline DriverInput straight_path(std::int64_t frames) {
  DriverInput input{.poses = {}, .device = VirtualPhantom(device_named("phantom-desktop")), .keep_lmds = {}};
  for (std::int64_t i = 0; i < frames; ++i) {
    Pose pose;
    pose.translation.x() = 0.1 + 1e-6 * static_cast<double>(i);
    input.poses.push_back(pose);
  }
  return input;
}

inline RealtimeSettings quick() {
  RealtimeSettings settings;
  settings.choice.floor_s = 0.02;
  return settings;
}

/// The force of ClockMethod at a frame of the straight path.
inline double force_at(std::int64_t frame) {
  return 1.0 - (0.1 + 1e-6 * static_cast<double>(frame));
}

/// Two bodies and a path that slides along their contact; for the registry's methods.
struct BlobRun {
  Scene scene = make_scene(make_blob(1.0, 0.3, 4), make_blob(0.9, 0.3, 4), 0.0);
  DriverInput input{.poses = {}, .device = VirtualPhantom(device_named("ideal")), .keep_lmds = {}};

  explicit BlobRun(std::int64_t frames) {
    std::mt19937_64 random(1);
    const Pose middle = grazing_pose(scene, 0.01, random);
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      Pose pose = middle;
      pose.translation +=
          0.01 * std::sin(0.005 * static_cast<double>(frame)) * middle.translation.unitOrthogonal();
      input.poses.push_back(pose);
    }
    scene.cutoff = 0.1;
  }
  DrivenMethod method(const std::string& name) const {
    return {name, [this, name] { return make_method(name, scene); },
            ForceProfile{ForceLaw::LINEAR, 0.1, 0.0, 1.0, 4.0}};
  }
};

/// Number of frames by source.
struct FrameCounts {
  std::int64_t ticks = 0, skipped = 0, lost = 0;
};
inline FrameCounts count_frames(const RealtimeRecord& clock) {
  FrameCounts counts;
  for (const FrameSource source : clock.frame_source)
    ++(source == FrameSource::TICK      ? counts.ticks
       : source == FrameSource::SKIPPED ? counts.skipped
                                        : counts.lost);
  return counts;
}

}  // namespace lmdbench::testing
