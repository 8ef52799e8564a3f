// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/drivers/pose_source.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

std::optional<LoopFrame> PathPoses::render(const RenderedForce&) {
  frame_ = std::min(frame_ + 1, path_.size() - 1);
  return std::nullopt;
}

DevicePoses::DevicePoses(const LoopChoice& loop, std::vector<Pose> path, double period,
                         const Vec3& reference_M)
    : path_(std::move(path)),
      mesh_(loop, period, path_.front(), reference_M, loop.push_n, Vec3::Zero()),
      under_way_(static_cast<std::size_t>(loop.delay_frames)),
      pose_(mesh_.sensed_pose()) {}

std::optional<LoopFrame> DevicePoses::render(const RenderedForce& rendered) {
  LMDBENCH_EXPECTS(rendered.force.allFinite(), "a force that nobody clipped to the device");
  under_way_.push_back(rendered);
  const Pose true_pose = mesh_.pose();
  const LoopFrame frame{true_pose.translation, mesh_.velocity(),         under_way_.front(),
                        true_pose.rotation,    mesh_.angular_velocity(), mesh_.energy()};
  frame_ = std::min(frame_ + 1, path_.size() - 1);
  mesh_.advance(under_way_.front(), path_[frame_]);
  under_way_.pop_front();
  pose_ = mesh_.sensed_pose();
  return frame;
}

std::unique_ptr<PoseSource> pose_source(const DriverInput& input) {
  if (input.make_poses) return input.make_poses();
  if (!input.loop.closed) return std::make_unique<PathPoses>(input.poses);
  return std::make_unique<DevicePoses>(input.loop, input.poses, 1.0 / input.frame_rate_hz, input.reference_M);
}

}  // namespace lmdbench
