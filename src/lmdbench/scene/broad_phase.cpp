// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/near_pairs.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace lmdbench {

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

BroadPhase::BroadPhase(std::shared_ptr<const Scene> scene, const Tuning& tuning)
    : scene_(std::move(scene)), tuning_(tuning), movers_(scene_->mover_count()), grown_(movers_.size()) {
  std::map<const Body*, std::uint32_t> known;
  mesh_.reserve(scene_->object_count());
  for (std::size_t i = 0; i < scene_->object_count(); ++i) {
    const std::shared_ptr<const Body>& body = scene_->body(i);
    const auto [place, is_new] = known.try_emplace(body.get(), static_cast<std::uint32_t>(meshes_.size()));
    if (is_new) {
      meshes_.push_back({body, &body->prepared<MeshBounds>(), &body->prepared<MeshOutline>()});
      deformations_ += body->deformations();
    }
    mesh_.push_back(place->second);
  }
  begin();
}

void BroadPhase::begin() {
  reach_ = contact_reach(*scene_);
  LMDBENCH_EXPECTS(scene_->cutoff >= 0.0 && tuning_.slack >= 0.0,
                   "a cutoff or slack that is negative or not a number");
  const auto mover_count = static_cast<std::uint32_t>(movers_.size());
  for (std::uint32_t i = 0; i < mover_count; ++i) movers_[i].slack = tuning_.slack * bounds_of(i).radius;
  has_anchors_ = false;
  moving_tree_.reset();
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(scene_->fixed.size());
  for (std::uint32_t i = mover_count; i < mesh_.size(); ++i) boxes.push_back(box_of(i));
  standing_tree_.emplace(boxes);
}

void BroadPhase::follow_deformation() {
  std::uint64_t sum = 0;
  for (const Mesh& mesh : meshes_) sum += mesh.body->deformations();
  if (sum == deformations_) return;
  deformations_ = sum;
  begin();
}

const Pose& BroadPhase::anchor_of(std::uint32_t object) const {
  return object < movers_.size() ? movers_[object].anchor : scene_->fixed[object - movers_.size()].X_WF;
}

Eigen::AlignedBox3d BroadPhase::box_of(std::uint32_t object) const {
  return object < movers_.size() ? movers_[object].box
                                 : bounds_of(object).placed(RigidTransform(anchor_of(object)));
}

double BroadPhase::rounding_of(std::uint32_t a, std::uint32_t b) const {
  // Also for the pose in which the pair is looked at, which is rounded otherwise.
  return 4.0 * PLACING_ROUNDING *
         (bounds_of(a).coordinates(RigidTransform(anchor_of(a))) +
          bounds_of(b).coordinates(RigidTransform(anchor_of(b))));
}

double BroadPhase::room_of(std::uint32_t a, std::uint32_t b) const {
  LMDBENCH_EXPECTS(a < mesh_.size() && b < mesh_.size(), "an object of another scene");
  const double between_spheres = (RigidTransform(anchor_of(a)).point(bounds_of(a).centre) -
                                  RigidTransform(anchor_of(b)).point(bounds_of(b).centre))
                                     .norm() -
                                 bounds_of(a).radius - bounds_of(b).radius;
  const double between_boxes = box_of(a).exteriorDistance(box_of(b));
  return std::max(between_spheres, between_boxes) - rounding_of(a, b) - reach_;
}

double BroadPhase::room_by_outline(std::uint32_t a, std::uint32_t b) const {
  const RigidTransform X_FM(relative_pose(anchor_of(b), anchor_of(a)));
  return outline_distance(*mesh_of(a).outline, *mesh_of(b).outline, X_FM, reach_) - rounding_of(a, b) -
         reach_;
}

Eigen::AlignedBox3d BroadPhase::grown_box(std::uint32_t mover, double more) const {
  const Mover& one = movers_[mover];
  const Vec3 margin =
      Vec3::Constant((more + one.slack) * (1.0 + PLACING_ROUNDING) +
                     8.0 * PLACING_ROUNDING * bounds_of(mover).coordinates(RigidTransform(one.anchor)));
  return {one.box.min() - margin, one.box.max() + margin};
}

void BroadPhase::find_candidates(std::uint32_t mover, Work& work) {
  LMDBENCH_EXPECTS(mover < movers_.size(), "an object that stands asked as a mover");
  const auto look_at = [&](std::uint32_t object) {
    ++work.touched;
    const double room = room_of(mover, object);
    if (room > slack_of(mover) + slack_of(object)) return;
    found_.push_back({{std::min(mover, object), std::max(mover, object)}, std::max(room, 0.0)});
  };
  if (moving_tree_) {
    moving_tree_->touching(grown_[mover], touching_);
    for (const std::uint32_t other : touching_) {
      // Of two that are anchored in this frame the first one finds the second.
      if (other == mover || (is_stale(other) && other < mover)) continue;
      look_at(other);
    }
  }
  standing_tree_->touching(grown_box(mover, reach_), touching_);
  for (const std::uint32_t place : touching_) look_at(static_cast<std::uint32_t>(movers_.size()) + place);
}

void BroadPhase::anchor(const Pose& X_WM, Work& work) {
  const bool packs = !moving_tree_ || static_cast<double>(stale_.size()) >
                                          tuning_.pack_share * static_cast<double>(movers_.size());
  for (const std::uint32_t i : stale_) {
    Mover& mover = movers_[i];
    mover.anchor = scene_->pose(i, X_WM);
    mover.motion = 0.0;
    mover.box = bounds_of(i).placed(RigidTransform(mover.anchor));
    const Eigen::AlignedBox3d before = grown_[i];
    grown_[i] = grown_box(i, 0.5 * reach_);
    if (!packs) moving_tree_->move(i, before, grown_[i]);
  }
  if (packs && movers_.size() > 1) moving_tree_.emplace(grown_);
  has_anchors_ = true;
  work.queries += stale_.size();
  found_.clear();
  for (const std::uint32_t i : stale_) find_candidates(i, work);
  std::ranges::sort(found_, [](const Candidate& a, const Candidate& b) { return a < b; });
  merge_found();
}

void BroadPhase::merge_found() {
  merged_.clear();
  auto next = found_.begin();
  for (Candidate& kept : candidates_) {
    for (; next != found_.end() && *next < kept; ++next) merged_.push_back(std::move(*next));
    if (!is_stale(kept.mover) && !is_stale(kept.other)) {
      merged_.push_back(std::move(kept));
    } else if (next != found_.end() && !(kept < *next)) {  // the same pair
      next->method = std::move(kept.method);
    } else if (kept.method) {
      dropped_.push_back(std::move(kept));
    }
  }
  std::move(next, found_.end(), std::back_inserter(merged_));
  std::swap(candidates_, merged_);
}

void BroadPhase::advance(const Pose& X_WM, Work& work) {
  follow_deformation();
  stale_.clear();
  for (std::uint32_t i = 0; i < movers_.size(); ++i) {
    Mover& mover = movers_[i];
    if (has_anchors_) mover.motion = farthest_motion(bounds_of(i), mover.anchor, scene_->pose(i, X_WM));
    mover.is_stale = !has_anchors_ || !(mover.motion <= mover.slack);
    if (mover.is_stale) stale_.push_back(i);
  }
  if (!stale_.empty()) anchor(X_WM, work);
}

bool BroadPhase::is_near(Candidate& candidate, Work& work) const {
  const double used = motion_of(candidate.mover) + motion_of(candidate.other);
  if (candidate.room > used) return false;
  ++work.touched;
  if (!candidate.by_outline) {
    candidate.by_outline = true;
    candidate.room = std::max(candidate.room, room_by_outline(candidate.mover, candidate.other));
  }
  return candidate.room <= used;
}

void BroadPhase::by_distance(const Pose& X_WM,
                             const std::function<bool(std::uint32_t instance, double bound)>& visit) const {
  const RigidTransform transform(X_WM);
  const auto& moving = scene_->moving->prepared<MeshBounds>();
  const double radius = moving.radius + 8.0 * PLACING_ROUNDING * moving.coordinates(transform);
  standing_tree_->by_distance(transform.point(moving.centre), [&](std::uint32_t instance, double bound) {
    return visit(instance, std::max(0.0, bound - radius));
  });
}

NearestInstance nearest_instance(const Scene& scene, const BroadPhase& phase, const Pose& X_WM,
                                 double bound) {
  NearestInstance nearest;
  nearest.distance = bound;
  phase.by_distance(X_WM, [&](std::uint32_t instance, double at_least) {
    if (at_least > nearest.distance) return false;
    const FixedBody& fixed = scene.fixed[instance];
    const NearestPair pair =
        nearest_pair(*scene.moving, *fixed, relative_pose(fixed.X_WF, X_WM), nearest.distance);
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
