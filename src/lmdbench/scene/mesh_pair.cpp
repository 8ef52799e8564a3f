// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/mesh_pair.h>

#include <utility>

namespace lmdbench {
namespace {

void move_points(Lmd& lmd, const Vec3& offset) {
  if (offset.isZero(0.0)) return;  // which would take the sign of a zero
  lmd.point_moving += offset;
  lmd.point_fixed += offset;
}

}  // namespace

PlacedPair PlacedPair::of(const Scene& scene, const ObjectPair& pair, const Pose& X_WM) {
  if (!scene.several_move() && !scene.is_world()) return {.X_FM = X_WM, .is_world = true};
  const Pose &X_WF = scene.pose(pair.other, X_WM), &X_WA = scene.pose(pair.mover, X_WM);
  return {.X_WF = RigidTransform(X_WF), .X_FM = relative_pose(X_WF, X_WA)};
}

void PlacedPair::to_world(Lmd& lmd, std::int32_t number) const {
  lmd.fixed_body = number;
  if (is_world) return move_points(lmd, origin_F);
  lmd.point_moving = X_WF.point(lmd.point_moving + origin_F);
  lmd.point_fixed = X_WF.point(lmd.point_fixed + origin_F);
  lmd.direction = X_WF.direction(lmd.direction);
}

void PlacedPair::to_mesh(Lmd& lmd) const {
  lmd.fixed_body = 0;
  if (is_world) return move_points(lmd, -origin_F);
  lmd.point_moving = X_WF.rotation.transpose() * (lmd.point_moving - X_WF.translation) - origin_F;
  lmd.point_fixed = X_WF.rotation.transpose() * (lmd.point_fixed - X_WF.translation) - origin_F;
  lmd.direction = X_WF.rotation.transpose() * lmd.direction;
}

MeshPair::MeshPair(const Scene& of_pair, const Make& make)
    : of_pair_(of_pair), make_(make), frame_(of_pair), deformations_(deformations()) {
  LMDBENCH_EXPECTS(of_pair.is_pair(), "a scene that has still to be taken apart");
  give_back(take());
  keeps_frames_ = shared().description().frame_coherent;
  sees_deformation_ = shared().description().follows_deformation && !frame_.differs();
}

std::uint64_t MeshPair::deformations() const {
  return std::uint64_t{of_pair_.moving->deformations()} + of_pair_.fixed.front()->deformations();
}

bool MeshPair::follow_deformation() {
  if (sees_deformation_ || deformations() == deformations_) return false;
  deformations_ = deformations();
  frame_ = NearFrame(of_pair_);
  idle_.clear();
  give_back(take());
  return true;
}

PlacedPair MeshPair::in_near_frame(PlacedPair pair) const {
  pair.X_FM = frame_.to_near(pair.X_FM);
  pair.origin_F = frame_.origin_W();
  return pair;
}

std::unique_ptr<Method> MeshPair::take() {
  // Results kept for other objects with these meshes are as good as those of an earlier pose:
  // certificates know how far the relative pose has moved.
  if (idle_.empty()) {
    ++made_;
    return make_(frame_.scene());
  }
  LMDBENCH_EXPECTS(idle_.back() != nullptr, "a method that was taken twice");
  std::unique_ptr<Method> method = std::move(idle_.back());
  idle_.pop_back();
  return method;
}

}  // namespace lmdbench
