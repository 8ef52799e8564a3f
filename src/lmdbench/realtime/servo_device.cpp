// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_device.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

const Pose& RecordedDevice::sense(std::int64_t period, std::int64_t) {
  return path_[std::min(static_cast<std::size_t>(period), path_.size() - 1)];
}

void RecordedDevice::render(const RenderedForce&, std::int64_t) {}

SimulatedServoDevice::SimulatedServoDevice(const LoopChoice& loop, const std::vector<Pose>& path,
                                           std::int64_t start, std::int64_t period, std::int64_t steps,
                                           double calls_a_period, const Vec3& reference_M)
    : path_(path),
      start_(start),
      step_ns_(period / steps),
      steps_(steps),
      delay_ns_(loop.delay_frames * period),
      mesh_(loop, 1e-9 * static_cast<double>(step_ns_), path.front(), reference_M, loop.push_n, Vec3::Zero()),
      // Four times as many as come within the delay: calls may bunch.
      due_(4 * static_cast<std::size_t>(
                   std::ceil(std::max(calls_a_period, 1.0) * static_cast<double>(loop.delay_frames + 2)))),
      pose_(mesh_.sensed_pose()) {}

Pose SimulatedServoDevice::path_at(std::int64_t step) const {
  const auto last = static_cast<std::int64_t>(path_.size()) - 1;
  const std::int64_t frame = std::min(step / steps_, last);
  const Pose& before = path_[static_cast<std::size_t>(frame)];
  if (frame == last || step % steps_ == 0) return before;
  const Pose& after = path_[static_cast<std::size_t>(frame) + 1];
  const double share = static_cast<double>(step % steps_) / static_cast<double>(steps_);
  return {before.translation + share * (after.translation - before.translation),
          before.rotation.slerp(share, after.rotation)};
}

bool SimulatedServoDevice::is_due(const Due& due, std::int64_t now) const {
  return due.at <= now + step_ns_ / 2;
}

void SimulatedServoDevice::hold_next() {
  held_ = due_[first_due_].rendered;
  first_due_ = (first_due_ + 1) % due_.size();
  --due_count_;
}

void SimulatedServoDevice::advance_to(std::int64_t now) {
  // To the nearest step: a force within half a step of a tick belongs to it.
  const std::int64_t wanted = (now - start_ + step_ns_ / 2) / step_ns_;
  for (; step_ < wanted; ++step_) {
    while (due_count_ > 0 && is_due(due_[first_due_], start_ + step_ * step_ns_)) hold_next();
    mesh_.advance(held_, path_at(step_ + 1));
  }
}

const Pose& SimulatedServoDevice::sense(std::int64_t, std::int64_t now) {
  advance_to(now);
  const Pose true_pose = mesh_.pose();
  frame_ = {true_pose.translation, mesh_.velocity(),         held_,
            true_pose.rotation,    mesh_.angular_velocity(), mesh_.energy()};
  pose_ = mesh_.sensed_pose();
  return pose_;
}

void SimulatedServoDevice::render(const RenderedForce& rendered, std::int64_t now) {
  // The ring is full: the device calls far more often than it told.
  if (due_count_ == due_.size()) hold_next();
  due_[(first_due_ + due_count_++) % due_.size()] = {now + delay_ns_, rendered};
  // What is due by the step that `advance_to` begins with.
  frame_.held = held_;
  for (std::size_t i = 0; i < due_count_; ++i) {
    const Due& due = due_[(first_due_ + i) % due_.size()];
    if (is_due(due, now)) frame_.held = due.rendered;
  }
}

}  // namespace lmdbench
