// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/well_formed.h>

#include <fmt/format.h>
#include <study/completeness/judge.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench::completeness {
namespace {

std::string describe(const Lmd& lmd) {
  return fmt::format("{} {} on {} {} of body {} at {:.17g} m", to_string(lmd.feature_moving.kind),
                     lmd.feature_moving.index, to_string(lmd.feature_fixed.kind), lmd.feature_fixed.index,
                     lmd.fixed_body, lmd.distance);
}

/// How far both points are from the other's [m].
double points_apart(const Lmd& a, const Lmd& b) {
  return std::max((a.point_moving - b.point_moving).norm(), (a.point_fixed - b.point_fixed).norm());
}

/// Of several of one pair the nearest, at one place that of the most equal distance.
const Lmd* find_pair(const LmdSet& set, const Lmd& wanted) {
  const Lmd* nearest = nullptr;
  const auto apart = [&](const Lmd& lmd) {
    return std::pair(points_apart(lmd, wanted), std::abs(lmd.distance - wanted.distance));
  };
  for (const Lmd& lmd : set)
    if (same_feature_pair(lmd, wanted) && lmd.intersecting == wanted.intersecting &&
        (nearest == nullptr || apart(lmd) < apart(*nearest)))
      nearest = &lmd;
  return nearest;
}

bool same_direction(const Lmd& a, const Lmd& b) {
  return a.direction == b.direction || (a.direction.hasNaN() && b.direction.hasNaN());
}

/// LMDs beyond the first of a feature pair. Intersecting LMDs are counted apart: their feature pair
/// may carry an LMD elsewhere.
std::size_t duplicates(const LmdSet& set) {
  LmdSet apart, touching;
  for (const Lmd& lmd : set) (lmd.intersecting ? touching : apart).push_back(lmd);
  return set.size() - distinct_pairs(apart).size() - distinct_pairs(touching).size();
}

}  // namespace

Judgement& Judgement::operator+=(const Judgement& other) {
  same += other.same;
  neighbours += other.neighbours;
  duplicates += other.duplicates;
  poses += other.poses;
  wrong_poses += other.wrong_poses;
  nearest_asked += other.nearest_asked;
  worst_distance_difference = std::max(worst_distance_difference, other.worst_distance_difference);
  worst_point_difference = std::max(worst_point_difference, other.worst_point_difference);
  return *this;
}

Judgement judge(const LmdSet& truth, const LmdSet& reported, const Scene& scene, double diagonal,
                std::string& objection, const std::optional<NearestLmd>& nearest) {
  Judgement result;
  result.poses = 1;
  result.same = agreement(truth, reported, Match::SAME_FEATURES, scene);
  result.neighbours = agreement(truth, reported, Match::NEIGHBOURING_FEATURES, scene);
  const std::size_t reported_twice = duplicates(reported);
  result.duplicates = reported_twice - std::min(reported_twice, duplicates(truth));
  objection.clear();
  const auto object = [&](const std::string& what) { objection += (objection.empty() ? "" : "; ") + what; };
  if (result.duplicates > 0) object(fmt::format("{} duplicates", result.duplicates));
  for (const Lmd& lmd : truth) {
    const Lmd* same = find_pair(reported, lmd);
    if (same == nullptr) {
      object("missed " + describe(lmd));
      continue;
    }
    const double distance = std::abs(lmd.distance - same->distance) / diagonal;
    const double point = points_apart(lmd, *same) / diagonal;
    result.worst_distance_difference = std::max(result.worst_distance_difference, distance);
    result.worst_point_difference = std::max(result.worst_point_difference, point);
    // Written so that NaN fails.
    if (!(distance <= POSITION_TOLERANCE &&
          point <= (lmd.intersecting ? CROSSING_TOLERANCE : POSITION_TOLERANCE)))
      object(fmt::format("{}: distance off by {:.2g}, points by {:.2g} of the diagonal", describe(lmd),
                         distance, point));
    if (!same_direction(lmd, *same))
      object(fmt::format("{}: another direction, {:.17g} {:.17g} {:.17g}", describe(lmd), same->direction.x(),
                         same->direction.y(), same->direction.z()));
    if (!is_well_formed(*same, scene))
      object(fmt::format("{}: not well formed, with triangles {} and {}", describe(lmd),
                         same->triangle_moving, same->triangle_fixed));
  }
  for (const Lmd& lmd : reported)
    if (find_pair(truth, lmd) == nullptr) object("reported " + describe(lmd) + ", which is none");
  if (!std::ranges::is_sorted(reported, lmd_less)) object("not in order");
  if (nearest) {
    result.nearest_asked = 1;
    const double least = minimum_distance(reported);
    if (!(std::abs(least - nearest->distance) <= nearest->tolerance))
      object(fmt::format("the nearest pair, at {:.17g} m, is no LMD; least distance {:.17g} m",
                         nearest->distance, least));
  }
  result.wrong_poses = objection.empty() ? 0 : 1;
  return result;
}

}  // namespace lmdbench::completeness
