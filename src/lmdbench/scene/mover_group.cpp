// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/mover_group.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace lmdbench {

namespace {

bool is_before(const auto& a, const auto& b) {
  return std::tie(a.mover, a.other) < std::tie(b.mover, b.other);
}

void refuse_bad_poses(std::span<const Pose> poses, std::size_t movers) {
  if (poses.size() != movers)
    throw UsageError("", "poses", fmt::format("{} poses of {} movers", poses.size(), movers),
                     "give one a mover");
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!poses[i].translation.allFinite() ||
        poses[i].translation.cwiseAbs().maxCoeff() > LARGEST_COORDINATE ||
        !(std::abs(poses[i].rotation.squaredNorm() - 1.0) <= UNIT_TOLERANCE))  // true for NaN, too
      throw UsageError("", fmt::format("pose {}", i), "is no rigid transform of finite size",
                       "give a unit quaternion and a finite translation");
}

}  // namespace

MoverGroup::MoverGroup(const std::vector<std::shared_ptr<const Body>>& movers,
                       const std::vector<FixedBody>& standing, double cutoff, MeshPair::Make make,
                       const Tuning& tuning)
    : mover_count_(movers.size()), cutoff_(cutoff), make_(std::move(make)), tuning_(tuning) {
  objects_.reserve(movers.size() + standing.size());
  const auto add = [this](const std::shared_ptr<const Body>& body, const Pose& pose) {
    const bool same = !objects_.empty() && objects_.back().body == body;  // A look-up costs a lock.
    objects_.push_back({body,
                        same ? objects_.back().bounds : &body->prepared<MeshBounds>(),
                        same ? objects_.back().outline : &body->prepared<MeshOutline>(),
                        pose,
                        {}});
  };
  for (const auto& mover : movers) add(mover, Pose{});
  for (const FixedBody& fixed : standing) add(fixed.body, fixed.X_WF);
  for (const Object& object : objects_) bodies_.push_back(object.body);
  std::ranges::sort(bodies_);
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  bodies_.shrink_to_fit();
  begin();
}

void MoverGroup::begin() {
  pairs_.clear();
  meshes_.clear();
  moving_tree_.reset();
  grown_.assign(mover_count_, {});
  is_stale_.assign(mover_count_, false);
  double known = 0.0;
  for (Object& object : objects_) known = std::max(known, object.bounds->known);
  reach_ = cutoff_ + 4.0 * known;
  LMDBENCH_EXPECTS(cutoff_ >= 0.0, "a cutoff that is negative or not a number");
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    Object& object = objects_[i];
    if (i < mover_count_) {
      object.slack = tuning_.slack * object.bounds->radius;
    } else {
      object.box = object.bounds->placed(RigidTransform(object.anchor));
      boxes.push_back(object.box);
    }
  }
  standing_tree_.emplace(boxes);
}

void MoverGroup::look_for_deformation() {
  std::uint64_t sum = 0;
  for (const auto& body : bodies_) sum += body->deformations();
  if (sum == deformations_) return;
  deformations_ = sum;
  begin();
}

double MoverGroup::rounding_of(const Object& a, const Object& b) const {
  // Also for the pose in which the pair is looked at, which is rounded otherwise.
  return 4.0 * PLACING_ROUNDING *
         (a.bounds->coordinates(RigidTransform(a.anchor)) + b.bounds->coordinates(RigidTransform(b.anchor)));
}

double MoverGroup::room_of(const Object& a, const Object& b) const {
  LMDBENCH_EXPECTS(a.bounds != nullptr && b.bounds != nullptr, "an object that was never added");
  const double between_spheres =
      (RigidTransform(a.anchor).point(a.bounds->centre) - RigidTransform(b.anchor).point(b.bounds->centre))
          .norm() -
      a.bounds->radius - b.bounds->radius;
  return std::max(between_spheres, a.box.exteriorDistance(b.box)) - rounding_of(a, b) - reach_;
}

double MoverGroup::room_by_outline(const Object& a, const Object& b) const {
  const RigidTransform X_FM(relative_pose(b.anchor, a.anchor));
  return outline_distance(*a.outline, *b.outline, X_FM, reach_) - rounding_of(a, b) - reach_;
}

Eigen::AlignedBox3d MoverGroup::grown_box(const Object& mover, double more) const {
  const Vec3 margin =
      Vec3::Constant((more + mover.slack) * (1.0 + PLACING_ROUNDING) +
                     8.0 * PLACING_ROUNDING * mover.bounds->coordinates(RigidTransform(mover.anchor)));
  return {mover.box.min() - margin, mover.box.max() + margin};
}

void MoverGroup::find_candidates(std::uint32_t mover, Work& work) {
  LMDBENCH_EXPECTS(mover < mover_count_, "an object that stands asked as a mover");
  const Object& one = objects_[mover];
  const auto look_at = [&](std::uint32_t object) {
    const Object& other = objects_[object];
    ++work.pairs_touched;
    const double room = room_of(one, other);
    if (room > one.slack + other.slack) return;
    found_.push_back({std::min(mover, object), std::max(mover, object), std::max(room, 0.0)});
  };
  moving_tree_->touching(grown_[mover], touching_);
  for (const std::uint32_t other : touching_) {
    // Of two that are anchored in this frame the first one finds the second.
    if (other == mover || (is_stale_[other] && other < mover)) continue;
    look_at(other);
  }
  standing_tree_->touching(grown_box(one, reach_), touching_);
  for (const std::uint32_t place : touching_) look_at(static_cast<std::uint32_t>(mover_count_) + place);
}

void MoverGroup::anchor(std::span<const Pose> poses, Work& work) {
  const bool packs = !moving_tree_ || static_cast<double>(stale_.size()) >
                                          tuning_.pack_share * static_cast<double>(mover_count_);
  for (const std::uint32_t i : stale_) {
    Object& mover = objects_[i];
    mover.anchor = poses[i];
    mover.motion = 0.0;
    mover.box = mover.bounds->placed(RigidTransform(mover.anchor));
    const Eigen::AlignedBox3d before = grown_[i];
    grown_[i] = grown_box(mover, 0.5 * reach_);
    if (!packs) moving_tree_->move(i, before, grown_[i]);
  }
  if (packs) moving_tree_.emplace(grown_);
  work.anchored += stale_.size();
  found_.clear();
  for (const std::uint32_t i : stale_) find_candidates(i, work);
  std::ranges::sort(found_, [](const Candidate& a, const Candidate& b) { return is_before(a, b); });
  merge_found();
}

void MoverGroup::merge_found() {
  merged_.clear();
  auto next = found_.begin();
  for (Candidate& kept : pairs_) {
    for (; next != found_.end() && is_before(*next, kept); ++next) merged_.push_back(std::move(*next));
    if (!is_stale_[kept.mover] && !(is_mover(kept.other) && is_stale_[kept.other])) {
      merged_.push_back(std::move(kept));
    } else if (next != found_.end() && !is_before(kept, *next)) {  // the same pair
      next->meshes = kept.meshes;
      next->method = std::move(kept.method);
    } else if (kept.method) {
      kept.meshes->give_back(std::move(kept.method));
    }
  }
  std::move(next, found_.end(), std::back_inserter(merged_));
  std::swap(pairs_, merged_);
}

std::size_t MoverGroup::method_count() const {
  std::size_t count = 0;
  for (const auto& [bodies, meshes] : meshes_) count += meshes.made();
  return count;
}

bool MoverGroup::is_near(Candidate& candidate, Work& work) const {
  const Object &mover = objects_[candidate.mover], &other = objects_[candidate.other];
  const double used = mover.motion + other.motion;
  if (candidate.room > used) return false;
  ++work.pairs_touched;
  if (!candidate.by_outline) {
    candidate.by_outline = true;
    candidate.room = std::max(candidate.room, room_by_outline(mover, other));
  }
  return candidate.room <= used;
}

Method& MoverGroup::method_of(Candidate& candidate) {
  const std::shared_ptr<const Body>&mover = objects_[candidate.mover].body,
                              &other = objects_[candidate.other].body;
  if (candidate.meshes == nullptr) {
    const std::pair key(mover.get(), other.get());
    auto place = meshes_.find(key);
    if (place == meshes_.end()) place = meshes_.try_emplace(key, Scene{mover, {other}, cutoff_}, make_).first;
    candidate.meshes = &place->second;
  }
  if (!candidate.meshes->keeps_frames()) return candidate.meshes->shared();
  if (!candidate.method) candidate.method = candidate.meshes->take(make_);
  return *candidate.method;
}

void MoverGroup::for_each_near(std::span<const Pose> poses, Work& work, const Ask& ask) {
  refuse_bad_poses(poses, mover_count_);
  look_for_deformation();
  stale_.clear();
  for (std::uint32_t i = 0; i < mover_count_; ++i) {
    Object& mover = objects_[i];
    if (moving_tree_) mover.motion = farthest_motion(*mover.bounds, mover.anchor, poses[i]);
    is_stale_[i] = !moving_tree_ || !(mover.motion <= mover.slack);
    if (is_stale_[i]) stale_.push_back(i);
  }
  if (!stale_.empty()) anchor(poses, work);
  for (Candidate& candidate : pairs_) {
    if (!is_near(candidate, work)) continue;
    Method& method = method_of(candidate);
    const Pose& X_WF = is_mover(candidate.other) ? poses[candidate.other] : objects_[candidate.other].anchor;
    ++work.pairs_searched;
    ask(candidate.mover, candidate.other, method, candidate.meshes->placed(X_WF, poses[candidate.mover]));
  }
}

void MoverGroup::search(std::span<const Pose> poses, MoverContacts& contacts, Work& work) {
  contacts.pairs.clear();
  contacts.lmds.clear();
  for_each_near(poses, work,
                [&](std::uint32_t mover, std::uint32_t other, Method& method, const PlacedPair& place) {
                  method.search(place.X_FM, lmds_, work.of_methods);
                  if (lmds_.empty()) return;
                  contacts.pairs.push_back({mover, other, contacts.lmds.size(), lmds_.size()});
                  for (Lmd& lmd : lmds_) {
                    place.to_world(lmd, other);
                    contacts.lmds.push_back(lmd);
                  }
                });
}

}  // namespace lmdbench
