// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/pose_source.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

std::optional<LoopFrame> PathPoses::render(const Vec3&) {
  frame_ = std::min(frame_ + 1, path_.size() - 1);
  return std::nullopt;
}

DevicePoses::DevicePoses(const LoopChoice& loop, std::vector<Pose> path, double period)
    : path_(std::move(path)),
      device_(loop.dynamics, loop.integration, period, path_.front().translation, loop.push_n,
              loop.resolution_m),
      under_way_(static_cast<std::size_t>(loop.delay_frames), Vec3::Zero()) {
  sense();
}

void DevicePoses::sense() {
  pose_ = {device_.sensed_position(), path_[frame_].rotation};
}

std::optional<LoopFrame> DevicePoses::render(const Vec3& force_W) {
  under_way_.push_back(force_W);
  const LoopFrame frame{device_.position(), device_.velocity(), under_way_.front(), device_.energy()};
  frame_ = std::min(frame_ + 1, path_.size() - 1);
  device_.advance(under_way_.front(), path_[frame_].translation);
  under_way_.pop_front();
  sense();
  return frame;
}

}  // namespace lmdbench
