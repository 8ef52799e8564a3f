// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/held_mesh.h>

namespace lmdbench {
namespace {

Vec3 point_of(const Pose& X_WM, const Vec3& p_M) {
  return p_M.isZero(0.0) ? X_WM.translation : RigidTransform(X_WM).point(p_M);
}

/// X_WM of a mesh whose point p_M is at p_W.
Pose pose_with_point(const Vec3& p_W, const Eigen::Quaterniond& R_WM, const Vec3& p_M) {
  return {p_M.isZero(0.0) ? p_W : Vec3(p_W - R_WM * p_M), R_WM};
}

}  // namespace

HeldMesh::HeldMesh(const LoopChoice& loop, double period, const Pose& start, const Vec3& reference_M,
                   const Vec3& push_W, const Vec3& push_torque_W)
    : place_(loop.dynamics, period, point_of(start, loop.rotation ? reference_M : Vec3::Zero()), push_W,
             loop.resolution_m),
      held_M_(loop.rotation ? reference_M : Vec3::Zero()),
      path_orientation_(start.rotation) {
  if (loop.rotation)
    gimbal_.emplace(loop.rotation->dynamics, period, start.rotation, push_torque_W,
                    loop.rotation->resolution_rad);
}

void HeldMesh::advance(const RenderedForce& held, const Pose& next_on_path) {
  place_.advance(held.force, point_of(next_on_path, held_M_));
  if (gimbal_) gimbal_->advance(held.torque, next_on_path.rotation);
  path_orientation_ = next_on_path.rotation;
}

Pose HeldMesh::pose() const {
  return pose_with_point(place_.position(), gimbal_ ? gimbal_->orientation() : path_orientation_, held_M_);
}

Pose HeldMesh::sensed_pose() const {
  return pose_with_point(place_.sensed_position(),
                         gimbal_ ? gimbal_->sensed_orientation() : path_orientation_, held_M_);
}

Vec3 HeldMesh::velocity() const {
  if (!gimbal_) return place_.velocity();
  return place_.velocity() - gimbal_->angular_velocity().cross(gimbal_->orientation() * held_M_);
}

EnergyAccount HeldMesh::energy() const {
  EnergyAccount account = place_.energy();
  if (gimbal_) account += gimbal_->energy();
  return account;
}

Vec3 HeldMesh::turn() const {
  return gimbal_ ? gimbal_->offset() : Vec3(Vec3::Zero());
}

Vec3 HeldMesh::angular_velocity() const {
  return gimbal_ ? gimbal_->angular_velocity() : Vec3(Vec3::Zero());
}

void HeldMesh::strike(const Vec3& velocity_W, const Vec3& angular_velocity_W) {
  place_.strike(velocity_W);
  if (gimbal_) gimbal_->strike(angular_velocity_W);
}

}  // namespace lmdbench
