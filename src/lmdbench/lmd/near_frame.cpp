// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/near_frame.h>

#include <utility>

namespace lmdbench {

namespace {

double half_diagonal(const Eigen::AlignedBox3d& box) {
  return box.isEmpty() ? 0.0 : 0.5 * box.diagonal().norm();
}

/// The middle of the box where it is far from the origin, else the origin.
Vec3 near_origin(const Eigen::AlignedBox3d& box, double radius) {
  if (box.isEmpty() || !(box.center().norm() > FAR_AWAY * radius)) return Vec3::Zero();
  return box.center();
}

std::shared_ptr<const Body> moved(const std::shared_ptr<const Body>& body, const Vec3& origin) {
  if (origin.isZero(0.0)) return body;
  // Normals and adjacency come of differences of vertices, which stay the same.
  Surface surface = body->surface();
  for (Vec3& vertex : surface.mesh.vertices) vertex -= origin;
  return std::make_shared<const Body>(body->name(), std::move(surface));
}

}  // namespace

NearFrame::NearFrame(const Scene& of_pair) : scene_(of_pair) {
  std::shared_ptr<const Body>& fixed = scene_.fixed.front().body;
  const Eigen::AlignedBox3d box_M = scene_.moving->box_at_rest(), box_W = fixed->box_at_rest();
  origin_M_ = near_origin(box_M, half_diagonal(box_M));
  origin_W_ = near_origin(box_W, half_diagonal(box_W) + half_diagonal(box_M));
  differs_ = !origin_M_.isZero(0.0) || !origin_W_.isZero(0.0);
  scene_.moving = moved(scene_.moving, origin_M_);
  fixed = moved(fixed, origin_W_);
}

Pose NearFrame::to_near(const Pose& X_WM) const {
  if (!differs_) return X_WM;
  Pose near = X_WM;
  near.translation = (X_WM.translation - origin_W_) + X_WM.rotation * origin_M_;
  return near;
}

}  // namespace lmdbench
