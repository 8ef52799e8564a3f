// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/mesh_pair.h>

namespace lmdbench {

void PlacedPair::to_world(Lmd& lmd, std::uint32_t fixed_body) const {
  lmd.fixed_body = static_cast<std::int32_t>(fixed_body);
  lmd.point_moving = X_WF.point(lmd.point_moving + origin_F);
  lmd.point_fixed = X_WF.point(lmd.point_fixed + origin_F);
  lmd.direction = X_WF.direction(lmd.direction);
}

void PlacedPair::to_mesh(Lmd& lmd) const {
  lmd.fixed_body = 0;
  lmd.point_moving = X_WF.rotation.transpose() * (lmd.point_moving - X_WF.translation) - origin_F;
  lmd.point_fixed = X_WF.rotation.transpose() * (lmd.point_fixed - X_WF.translation) - origin_F;
  lmd.direction = X_WF.rotation.transpose() * lmd.direction;
}

MeshPair::MeshPair(const Scene& of_pair, const Make& make) : frame_(of_pair) {
  idle_.push_back(make(frame_.scene()));
  keeps_frames_ = idle_.front()->description().frame_coherent;
}

PlacedPair MeshPair::placed(const Pose& X_WF, const Pose& X_WM) const {
  return {RigidTransform(X_WF), frame_.origin_W(), frame_.to_near(relative_pose(X_WF, X_WM))};
}

std::unique_ptr<Method> MeshPair::take(const Make& make) {
  // What it keeps of other objects with these meshes is as good as what it keeps of an earlier pose: a certificate knows how far the
  // relative pose has moved since.
  if (idle_.empty()) {
    ++made_;
    return make(frame_.scene());
  }
  LMDBENCH_EXPECTS(idle_.back() != nullptr, "a method that was taken twice");
  std::unique_ptr<Method> method = std::move(idle_.back());
  idle_.pop_back();
  return method;
}

}  // namespace lmdbench
