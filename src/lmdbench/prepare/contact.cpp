// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace lmdbench {

DeformingDistance::DeformingDistance(const Scene& rest, const SceneMotion& motion)
    : bodies_(rest, motion),
      deformation_(motion.deformation),
      motion_(rest.moving->surface().mesh, deformation_->farthest(rest.moving.get())) {}

double DeformingDistance::look(std::int64_t frame, const Pose& X_WM) {
  bodies_.to_frame(frame);
  looked_at_ = X_WM;
  frame_ = frame;
  distance_ = nearest_distance(bodies_.scene(), X_WM);
  return distance_;
}

DeformingDistance::Interval DeformingDistance::known(std::int64_t frame, const Pose& X_WM) const {
  if (!looked_at_) return {};
  const double change = motion_.between(*looked_at_, X_WM) + motion_.slack(*looked_at_, X_WM) +
                        deformation_->way(frame_, frame) * (1.0 + MotionBound::ROUNDING);
  return {distance_ * (1.0 - MotionBound::ROUNDING) - change,
          distance_ * (1.0 + MotionBound::ROUNDING) + change};
}

namespace {

/// Whether one frame's distance bounds that of another.
bool is_one_deforming_pair(const Scene& rest, const SceneMotion& motion) {
  return motion.deformation && !motion.movers && !rest.is_world();
}

}  // namespace

std::vector<bool> frames_in_contact(const Scene& rest, const SceneMotion& motion,
                                    const std::vector<Pose>& poses, bool forecast) {
  if (!motion.is_any()) return frames_in_contact(rest, poses, forecast);
  std::vector<bool> in_contact;
  in_contact.reserve(poses.size());
  if (!is_one_deforming_pair(rest, motion)) {
    SceneFrames frames(rest, motion);
    NearestObjects nearest(frames.scene());
    for (const Pose& X_WM : poses) {
      frames.to_frame(static_cast<std::int64_t>(in_contact.size()));
      in_contact.push_back(nearest.any_within(X_WM, rest.cutoff));
    }
    return in_contact;
  }
  DeformingDistance distance(rest, motion);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto frame = static_cast<std::int64_t>(i);
    const DeformingDistance::Interval known =
        forecast ? distance.known(frame, poses[i]) : DeformingDistance::Interval();
    if (known.most < rest.cutoff)
      in_contact.push_back(true);
    else if (known.least > rest.cutoff)
      in_contact.push_back(false);
    else
      in_contact.push_back(distance.look(frame, poses[i]) <= rest.cutoff);
  }
  return in_contact;
}

namespace {

constexpr double ROUNDING = MotionBound::ROUNDING;

/// One fixed mesh: in contact or not, pose after pose.
class ContactScan {
 public:
  ContactScan(const Scene& scene, const Body& fixed, const MotionBound& motion)
      : tracker_(scene.moving->surface(), scene.moving->prepared<Hierarchy>(), fixed.surface(),
                 fixed.prepared<Hierarchy>()),
        motion_(motion),
        cutoff_(scene.cutoff) {}

  bool at(const Pose& X_WM) {
    // In contact as long as the last nearest triangles are.
    if (tracker_.last_pair(X_WM).distance <= cutoff_) return true;
    // Out of contact until the mesh can have moved through the excess of the gap.
    if (apart_ && motion_.between(*apart_, X_WM) + motion_.slack(*apart_, X_WM) < excess_) return false;
    const NearestPair pair = tracker_.nearest(X_WM);
    const bool in_contact = pair.triangle_moving >= 0 && pair.distance <= cutoff_;
    apart_.reset();
    if (!in_contact) {
      apart_ = X_WM;
      excess_ = pair.triangle_moving < 0 ? std::numeric_limits<double>::infinity()
                                         : pair.distance * (1.0 - ROUNDING) - cutoff_;
    }
    return in_contact;
  }

 private:
  NearestTracker tracker_;
  const MotionBound& motion_;
  double cutoff_;
  std::optional<Pose> apart_;  ///< Last pose searched without contact, ...
  double excess_ = 0.0;        ///< ... its gap minus the cutoff [m].
};

/// Distances to one fixed mesh, pose after pose.
class DistanceScan {
 public:
  DistanceScan(const Scene& scene, const Body& fixed, const MotionBound& motion)
      : tracker_(scene.moving->surface(), scene.moving->prepared<Hierarchy>(), fixed.surface(),
                 fixed.prepared<Hierarchy>()),
        motion_(motion) {}

  /// The exact distance, or infinity where a bound puts it above `limit`.
  double unless_beyond(const Pose& X_WM, double limit) {
    if (looked_at_) {
      const double nearer = motion_.between(*looked_at_, X_WM) + motion_.slack(*looked_at_, X_WM);
      if (distance_ * (1.0 - ROUNDING) - nearer > limit) return std::numeric_limits<double>::infinity();
      if (tracker_.last_pair(X_WM).distance == 0.0) return 0.0;  // no other pair is nearer
    }
    looked_at_ = X_WM;
    const NearestPair pair = tracker_.nearest(X_WM);
    distance_ = pair.triangle_moving < 0 ? std::numeric_limits<double>::infinity() : pair.distance;
    return distance_;
  }

 private:
  NearestTracker tracker_;
  const MotionBound& motion_;
  std::optional<Pose> looked_at_;
  double distance_ = 0.0;  ///< There [m].
};

}  // namespace

NearestObjects::Nearest NearestObjects::at(const Pose& X_WM, double bound) {
  Nearest nearest;
  double least = bound;
  for (const auto& [at_least, objects] : near_.within(bound, X_WM)) {
    if (at_least > least) break;
    const Body &mover = *scene_.body(objects.mover), &other = *scene_.body(objects.other);
    const NearestPair pair = nearest_pair(
        mover, other, relative_pose(scene_.pose(objects.other, X_WM), scene_.pose(objects.mover, X_WM)),
        least);
    if (pair.triangle_moving < 0 || !(pair.distance < nearest.distance)) continue;
    nearest = {pair.distance, objects, pair.triangle_moving, pair.triangle_fixed};
    least = pair.distance;
  }
  return nearest;
}

bool NearestObjects::any_within(const Pose& X_WM, double distance) {
  return std::ranges::any_of(near_.within(distance, X_WM), [&](const NearPairs::Pair& pair) {
    const Body &mover = *scene_.body(pair.objects.mover), &other = *scene_.body(pair.objects.other);
    return within_distance(
        mover, other,
        relative_pose(scene_.pose(pair.objects.other, X_WM), scene_.pose(pair.objects.mover, X_WM)),
        distance);
  });
}

SceneDistance::SceneDistance(const Scene& rest, const SceneMotion& motion) : frames_(rest, motion) {
  if (is_one_deforming_pair(rest, motion))
    deforming_.emplace(rest, motion);
  else if (motion.is_any())
    objects_.emplace(frames_.scene());
  else if (rest.is_world())
    phase_.emplace(rest);
}

double SceneDistance::at(std::int64_t frame, const Pose& X_WM, double bound) {
  if (deforming_)
    return deforming_->known(frame, X_WM).least >= bound ? std::numeric_limits<double>::infinity()
                                                         : deforming_->look(frame, X_WM);
  frames_.to_frame(frame);
  if (objects_) return objects_->at(X_WM, bound).distance;
  if (phase_) return nearest_instance(frames_.scene(), *phase_, X_WM, bound).distance;
  return nearest_distance(frames_.scene(), X_WM, bound);
}

double nearest_distance(const Scene& scene, const Pose& X_WM, double bound) {
  double least = std::numeric_limits<double>::infinity();
  for (const FixedBody& fixed : scene.fixed) {
    const NearestPair pair = nearest_pair(*scene.moving, *fixed, X_WM, std::min(bound, least));
    if (pair.triangle_moving >= 0) least = std::min(least, pair.distance);
  }
  return least;
}

std::vector<bool> frames_in_contact(const Scene& scene, const std::vector<Pose>& poses, bool forecast) {
  if (scene.is_world()) {
    const BroadPhase phase(scene);
    std::vector<bool> in_contact;
    for (const Pose& X_WM : poses)
      in_contact.push_back(nearest_instance(scene, phase, X_WM, scene.cutoff).instance >= 0);
    return in_contact;
  }
  const MotionBound motion(scene.moving->surface().mesh);
  std::vector<ContactScan> scans;
  for (const auto& fixed : scene.fixed) scans.emplace_back(scene, *fixed, motion);
  std::vector<bool> in_contact;
  in_contact.reserve(poses.size());
  for (const Pose& X_WM : poses) {
    if (forecast) {
      in_contact.push_back(
          std::any_of(scans.begin(), scans.end(), [&](ContactScan& scan) { return scan.at(X_WM); }));
      continue;
    }
    in_contact.push_back(std::any_of(scene.fixed.begin(), scene.fixed.end(), [&](const auto& fixed) {
      return within_distance(*scene.moving, *fixed, X_WM, scene.cutoff);
    }));
  }
  return in_contact;
}

Clearance clearance(const Scene& scene, std::span<const Pose> poses) {
  if (scene.is_world()) {
    const BroadPhase phase(scene);
    Clearance result;
    for (const Pose& X_WM : poses) {
      const NearestInstance nearest = nearest_instance(scene, phase, X_WM, result.least_m);
      result.least_m = std::min(result.least_m, nearest.distance);
      if (nearest.distance == 0.0) ++result.touching;
    }
    return result;
  }
  const MotionBound motion(scene.moving->surface().mesh);
  std::vector<DistanceScan> scans;
  for (const auto& fixed : scene.fixed) scans.emplace_back(scene, *fixed, motion);
  Clearance result;
  for (const Pose& X_WM : poses) {
    bool touching = false;
    for (DistanceScan& scan : scans) {
      const double distance = scan.unless_beyond(X_WM, result.least_m);
      result.least_m = std::min(result.least_m, distance);
      touching |= distance == 0.0;
    }
    if (touching) ++result.touching;
  }
  return result;
}

}  // namespace lmdbench
