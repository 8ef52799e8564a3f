// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/near_frame.h>
#include <lmdbench/lmd/own_wrench.h>

#include <Eigen/Geometry>

#include <utility>

namespace lmdbench {

namespace {

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

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

void move_points(LmdSet& lmds, const Vec3& offset) {
  for (Lmd& lmd : lmds) {
    lmd.point_moving += offset;
    lmd.point_fixed += offset;
  }
}

/// A method that works in a near frame.
class InNearFrame : public Method, public HasOwnWrench {
 public:
  InNearFrame(NearFrame frame, std::unique_ptr<Method> method)
      : frame_(std::move(frame)), method_(std::move(method)) {}

  const MethodDescription& description() const override { return method_->description(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    method_->search(frame_.to_near(X_WM), lmds, counters);
    frame_.to_world(lmds);
  }
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    frame_.to_near(lmds);
    method_->track(frame_.to_near(X_WM), lmds, counters);
    frame_.to_world(lmds);
  }
  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override {
    method_->find_critical(frame_.to_near(X_WM), critical, counters);
    for (CriticalPair& pair : critical) {
      pair.pair.point_moving += frame_.origin_W();
      pair.pair.point_fixed += frame_.origin_W();
    }
  }
  std::optional<OwnWrench> own_wrench() const override {
    std::optional<OwnWrench> own = own_wrench_of(*method_);
    if (own) own->about += frame_.origin_W();
    return own;
  }

 private:
  NearFrame frame_;
  std::unique_ptr<Method> method_;
};

}  // namespace

NearFrame::NearFrame(const Scene& scene) : scene_(scene) {
  const Eigen::AlignedBox3d moving = box_of(scene.moving->surface().mesh);
  Eigen::AlignedBox3d fixed;
  for (const auto& body : scene.fixed) fixed.extend(box_of(body->surface().mesh));
  origin_M_ = near_origin(moving, half_diagonal(moving));
  origin_W_ = near_origin(fixed, half_diagonal(fixed) + half_diagonal(moving));
  differs_ = !origin_M_.isZero(0.0) || !origin_W_.isZero(0.0);
  scene_.moving = moved(scene.moving, origin_M_);
  for (FixedBody& body : scene_.fixed) body.body = moved(body.body, origin_W_);
}

Pose NearFrame::to_near(const Pose& X_WM) const {
  Pose near = X_WM;
  near.translation = (X_WM.translation - origin_W_) + X_WM.rotation * origin_M_;
  return near;
}

void NearFrame::to_world(LmdSet& lmds) const {
  move_points(lmds, origin_W_);
}

void NearFrame::to_near(LmdSet& lmds) const {
  move_points(lmds, -origin_W_);
}

std::unique_ptr<Method> make_in_near_frame(const Scene& scene,
                                           const std::function<std::unique_ptr<Method>(const Scene&)>& make) {
  NearFrame frame(scene);
  if (!frame.differs()) return make(scene);
  std::unique_ptr<Method> method = make(frame.scene());
  return std::make_unique<InNearFrame>(std::move(frame), std::move(method));
}

}  // namespace lmdbench
