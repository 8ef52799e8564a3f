// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace lmdbench {
namespace {

std::vector<Eigen::AlignedBox3d> boxes_of(const Scene& scene) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(scene.fixed.size());
  const Body* last = nullptr;
  const MeshBounds* bounds = nullptr;
  for (const FixedBody& fixed : scene.fixed) {
    if (fixed.body.get() != last) bounds = &fixed->prepared<MeshBounds>();
    last = fixed.body.get();
    boxes.push_back(bounds->placed(RigidTransform(fixed.X_WF)));
  }
  return boxes;
}

bool has_less_room(const BroadPhase::Candidate& a, const BroadPhase::Candidate& b) {
  return std::tie(a.room, a.instance) < std::tie(b.room, b.instance);
}

}  // namespace

double farthest_motion(const MeshBounds& bounds, const Pose& from, const Pose& to) {
  LMDBENCH_EXPECTS(bounds.radius >= 0.0, "bounds of a mesh that was never looked at");
  const double way =
      ((to.translation - from.translation) + (to.rotation * bounds.centre - from.rotation * bounds.centre))
          .norm();
  const double half_turn_sine = (from.rotation.conjugate() * to.rotation).vec().norm();
  const double rounding = PLACING_ROUNDING * (from.translation.norm() + to.translation.norm() +
                                              2.0 * (bounds.centre.norm() + bounds.radius));
  return way + 2.0 * bounds.radius * std::min(half_turn_sine, 1.0) + rounding;
}

BroadPhase::BroadPhase(const Scene& scene, double slack)
    : moving_(scene.moving->prepared<MeshBounds>()),
      moving_outline_(&scene.moving->prepared<MeshOutline>()),
      slack_(slack * moving_.radius),
      tree_(boxes_of(scene)) {
  std::map<const Body*, std::uint32_t> known;
  mesh_.reserve(scene.fixed.size());
  poses_.reserve(scene.fixed.size());
  double known_fixed = 0.0;
  for (const FixedBody& fixed : scene.fixed) {
    const auto [place, is_new] =
        known.try_emplace(fixed.body.get(), static_cast<std::uint32_t>(meshes_.size()));
    if (is_new) {
      meshes_.push_back(fixed.body);
      bounds_.push_back(&fixed->prepared<MeshBounds>());
      outlines_.push_back(&fixed->prepared<MeshOutline>());
      known_fixed = std::max(known_fixed, bounds_.back()->known);
    }
    mesh_.push_back(place->second);
    poses_.push_back(fixed.X_WF);
  }
  reach_ = scene.cutoff + 2.0 * (moving_.known + known_fixed);
  LMDBENCH_ENSURES(mesh_.size() == poses_.size() && bounds_.size() == meshes_.size(),
                   "parallel arrays of unlike lengths");
  LMDBENCH_EXPECTS(scene.cutoff >= 0.0 && slack_ >= 0.0,
                   "a cutoff or slack that is negative or not a number");
}

double BroadPhase::room_of(std::uint32_t instance, const RigidTransform& X_WM,
                           const Eigen::AlignedBox3d& box) const {
  LMDBENCH_EXPECTS(instance < mesh_.size(), "an instance of another scene");
  const MeshBounds& bounds = *bounds_[mesh_[instance]];
  const RigidTransform X_WF(poses_[instance]);
  const double between_spheres =
      (X_WM.point(moving_.centre) - X_WF.point(bounds.centre)).norm() - moving_.radius - bounds.radius;
  const double between_boxes = box.exteriorDistance(bounds.placed(X_WF));
  // Also for the pose in which the pair is looked at, which is rounded otherwise.
  const double rounding = 4.0 * PLACING_ROUNDING * (moving_.coordinates(X_WM) + bounds.coordinates(X_WF));
  return std::max(between_spheres, between_boxes) - rounding - reach_;
}

double BroadPhase::room_by_outline(std::uint32_t instance) const {
  LMDBENCH_EXPECTS(has_asked_ && instance < mesh_.size(), "candidates of before the first question");
  const Pose& X_WF = poses_[instance];
  const std::size_t mesh = mesh_[instance];
  const RigidTransform X_FM(relative_pose(X_WF, asked_at_));
  const double rounding =
      4.0 * PLACING_ROUNDING *
      (moving_.coordinates(RigidTransform(asked_at_)) + bounds_[mesh]->coordinates(RigidTransform(X_WF)));
  return outline_distance(*moving_outline_, *outlines_[mesh], X_FM, reach_) - rounding - reach_;
}

void BroadPhase::ask(const Pose& X_WM, Work& work) {
  const RigidTransform transform(X_WM);
  const Eigen::AlignedBox3d box = moving_.placed(transform);
  const Vec3 margin = Vec3::Constant((reach_ + slack_) * (1.0 + PLACING_ROUNDING) +
                                     8.0 * PLACING_ROUNDING * moving_.coordinates(transform));
  tree_.touching({box.min() - margin, box.max() + margin}, found_);
  candidates_.clear();
  for (const std::uint32_t instance : found_) {
    const double room = room_of(instance, transform, box);
    if (room <= slack_) candidates_.push_back({instance, std::max(room, 0.0), false});
  }
  std::sort(candidates_.begin(), candidates_.end(), has_less_room);
  asked_at_ = X_WM;
  has_asked_ = true;
  near_count_ = 0;
  ++work.queries;
  work.touched += found_.size();
}

bool BroadPhase::advance(const Pose& X_WM, Work& work) {
  double motion = has_asked_ ? farthest_motion(moving_, asked_at_, X_WM) : 0.0;
  const bool asks = !has_asked_ || !(motion <= slack_);
  if (asks) {
    ask(X_WM, work);
    motion = 0.0;
  }
  near_count_ = 0;
  while (near_count_ < candidates_.size() && candidates_[near_count_].room <= motion) {
    Candidate candidate = candidates_[near_count_];
    ++work.touched;
    if (candidate.by_outline) {
      ++near_count_;
      continue;
    }
    candidate.by_outline = true;
    candidate.room = std::max(candidate.room, room_by_outline(candidate.instance));
    // To its new place; those between move forward.
    auto place = candidates_.begin() + static_cast<std::ptrdiff_t>(near_count_);
    for (; place + 1 != candidates_.end() && has_less_room(place[1], candidate); ++place) *place = place[1];
    *place = candidate;
  }
  return asks;
}

void BroadPhase::by_distance(const Pose& X_WM,
                             const std::function<bool(std::uint32_t instance, double bound)>& visit) const {
  const RigidTransform transform(X_WM);
  const double radius = moving_.radius + 8.0 * PLACING_ROUNDING * moving_.coordinates(transform);
  tree_.by_distance(transform.point(moving_.centre), [&](std::uint32_t instance, double bound) {
    return visit(instance, std::max(0.0, bound - radius));
  });
}

void BroadPhase::look_at_all(const Pose& X_WM, std::vector<std::uint32_t>& near) const {
  near.clear();
  const Vec3 centre = RigidTransform(X_WM).point(moving_.centre);
  for (std::uint32_t i = 0; i < size(); ++i) {
    const MeshBounds& bounds = *bounds_[mesh_[i]];
    const double distance = (poses_[i].translation + poses_[i].rotation * bounds.centre - centre).norm();
    const double rounding = 8.0 * PLACING_ROUNDING *
                            (centre.norm() + poses_[i].translation.norm() + bounds.centre.norm() +
                             bounds.radius + moving_.radius);
    if (distance - rounding <= reach_ + moving_.radius + bounds.radius) near.push_back(i);
  }
}

NearestInstance nearest_instance(const Scene& scene, const BroadPhase& phase, const Pose& X_WM,
                                 double bound) {
  NearestInstance nearest;
  nearest.distance = bound;
  phase.by_distance(X_WM, [&](std::uint32_t instance, double at_least) {
    if (at_least > nearest.distance) return false;
    const Body& fixed = *scene.fixed[instance];
    const NearestPair pair = nearest_pair(scene.moving->surface(), scene.moving->prepared<Hierarchy>(),
                                          fixed.surface(), fixed.prepared<Hierarchy>(),
                                          relative_pose(phase.pose_of(instance), X_WM), nearest.distance);
    if (pair.triangle_moving < 0 || !(pair.distance <= nearest.distance)) return true;
    const auto index = static_cast<std::int32_t>(instance);
    if (nearest.instance < 0 || pair.distance < nearest.distance || index < nearest.instance)
      nearest = {index, pair.distance, pair.triangle_moving, pair.triangle_fixed};
    return true;
  });
  if (nearest.instance < 0) nearest.distance = std::numeric_limits<double>::infinity();
  return nearest;
}

}  // namespace lmdbench
