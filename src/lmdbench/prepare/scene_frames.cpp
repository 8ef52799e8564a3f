// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/prepare/scene_frames.h>

#include <algorithm>
#include <chrono>

namespace lmdbench {

SceneFrames::SceneFrames(const Scene& rest, const SceneMotion& motion) : scene_(rest), motion_(motion) {
  if (motion_.movers) {
    LMDBENCH_EXPECTS(rest.movers.size() == motion_.movers->count(),
                     "a scene without the movers of its motion");
    poses_ = std::make_shared<std::vector<Pose>>(motion_.movers->poses.front());
    scene_.mover_poses = poses_;
  }
  if (!motion_.deformation) return;
  for (const DeformingBody& body : motion_.deformation->bodies()) {
    own_.push_back(std::make_shared<Body>(body.rest->name(), body.rest->surface()));
    const auto replace = [&](std::shared_ptr<const Body>& one) {
      if (one == body.rest) one = own_.back();
    };
    replace(scene_.moving);
    for (FixedBody& fixed : scene_.fixed) replace(fixed.body);
    for (std::shared_ptr<const Body>& mover : scene_.movers) replace(mover);
  }
}

void SceneFrames::prepare_to_deform() {
  for (const std::shared_ptr<Body>& body : own_) {
    vertices_ = body->surface().mesh.vertices;
    body->deform(vertices_);
  }
}

void SceneFrames::move_to_frame(std::int64_t frame) {
  if (!poses_) return;
  const std::vector<std::vector<Pose>>& poses = motion_.movers->poses;
  *poses_ = poses[std::min(static_cast<std::size_t>(frame), poses.size() - 1)];
}

double SceneFrames::to_frame(std::int64_t frame) {
  LMDBENCH_EXPECTS(!motion_.deformation || own_.size() == motion_.deformation->bodies().size(),
                   "a scene that was moved from");
  move_to_frame(frame);
  double seconds = 0.0;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    motion_.deformation->bodies()[i].vertices->at(std::min(frame, motion_.deformation->frames() - 1),
                                                  vertices_);
    const auto begin = std::chrono::steady_clock::now();
    own_[i]->deform(vertices_);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  return seconds;
}

}  // namespace lmdbench
