// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>

#include <fmt/format.h>
#include <judge/flat_judge.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::exact {
namespace {

/// Relative to the size: tolerances of an LMD's distance, and of its place at an area's centroid.
constexpr double TOLERANCE = 1e-9, CENTROID = 1e-9;
/// A basin whose climb or distance from the cutoff is within this factor of tolerance is undecided.
constexpr double MARGIN = 16.0;
/// Distances of one plateau are equal to this part of them: exact, except for one root.
constexpr double ROUNDING = 8.0 * std::numeric_limits<double>::epsilon();
/// Sine below which an outer side is left to tolerance.
constexpr double UNCERTAIN_SIDE = 1e-6;

double largest_coordinate(const Surface& surface) {
  double largest = 0.0;
  for (const Vec3& p : surface.mesh.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

double tolerance_of(const Surface& surface) {
  return std::max(surface.mesh.planar_tolerance, TOLERANCE * largest_coordinate(surface));
}

std::string at(double distance, const Vec3& p, const Vec3& q) {
  return fmt::format("at distance {:.17g}, {:.9g} {:.9g} {:.9g} and {:.9g} {:.9g} {:.9g}", distance, p.x(),
                     p.y(), p.z(), q.x(), q.y(), q.z());
}

std::string describe(const Lmd& lmd) {
  return fmt::format("{} {}, {} {} ", to_string(lmd.feature_moving.kind), lmd.feature_moving.index,
                     to_string(lmd.feature_fixed.kind), lmd.feature_fixed.index) +
         at(lmd.distance, lmd.point_moving, lmd.point_fixed);
}

}  // namespace

FlatCounts& FlatCounts::operator+=(const FlatCounts& other) {
  for (auto member : {&FlatCounts::poses, &FlatCounts::touching_poses, &FlatCounts::tolerance_poses,
                      &FlatCounts::faulty_poses, &FlatCounts::basins, &FlatCounts::areas, &FlatCounts::right,
                      &FlatCounts::with_way_down, &FlatCounts::tolerated, &FlatCounts::missed,
                      &FlatCounts::doubled, &FlatCounts::untrue, &FlatCounts::misplaced})
    this->*member += other.*member;
  return *this;
}

FlatTruth::FlatTruth(const Surface& moving, const Surface& fixed, const Pose& X_WM, double cutoff)
    : moving_(moving, RigidTransform(X_WM)),
      fixed_(fixed, RigidTransform()),
      size_(std::max(largest_coordinate(moving), largest_coordinate(fixed))),
      tolerance_(tolerance_of(moving) + tolerance_of(fixed)),
      cutoff_(cutoff),
      pairs_(std::make_unique<CellPairs>(moving_, fixed_, cutoff + 2.0 * MARGIN * tolerance_)) {
  for (std::size_t i = 0; i < pairs_->size(); ++i) touching_ = touching_ || (*pairs_)[i].distance == 0.0;
  if (touching_) return;
  small_climbs_ = find_basins(*pairs_, 0.0, std::numeric_limits<double>::min());
  std::erase_if(small_climbs_, [&](const Basin& basin) {
    return basin.climb <= ROUNDING * basin.least || basin.climb > MARGIN * tolerance_;
  });
  for (Basin& basin : find_basins(*pairs_, tolerance_, tolerance_ / MARGIN)) {
    Place place{std::move(basin), {}, Claim::NONE};
    place.claim = claim_of(place.basin);
    if (place.claim == Claim::NONE) continue;
    place.area = contact_area(*pairs_, place.basin.pairs);
    places_.push_back(std::move(place));
  }
}

std::size_t FlatTruth::demanded() const {
  return static_cast<std::size_t>(std::count_if(
      places_.begin(), places_.end(), [](const Place& place) { return place.claim == Claim::DEMANDED; }));
}

FlatTruth::Claim FlatTruth::claim_of(const Basin& basin) const {
  Claim claim = Claim::NONE;
  for (const std::size_t i : basin.pairs) {
    const CellPair& pair = (*pairs_)[i];
    if (!pair.critical || pair.distance > basin.least) continue;
    const Vec3 d = pair.q - pair.p;
    const double side = std::min(moving_.side(pair.a, d), fixed_.side(pair.b, -d));
    if (side > UNCERTAIN_SIDE) claim = std::max(claim, Claim::DEMANDED);
    if (std::abs(side) <= UNCERTAIN_SIDE) claim = std::max(claim, Claim::OPEN);
  }
  const bool near_the_cutoff = std::abs(basin.least - cutoff_) <= MARGIN * tolerance_;
  if (basin.least > cutoff_ && !near_the_cutoff) return Claim::NONE;
  if (near_the_cutoff || basin.climb <= MARGIN * tolerance_ || !is_one_minimum(basin))
    return std::min(claim, Claim::OPEN);
  return claim;
}

/// Whether a basin has one local minimum, maybe a plateau. Where borders cross by 1e-7, the climb
/// between parts of an overlap is 1e-12: tolerance decides whether they are one LMD or two.
bool FlatTruth::is_one_minimum(const Basin& basin) const {
  return std::ranges::none_of(small_climbs_, [&](const Basin& small) {
    return std::ranges::any_of(small.pairs, [&](std::size_t i) {
      return (*pairs_)[i].distance <= small.least && std::ranges::binary_search(basin.pairs, i);
    });
  });
}

bool FlatTruth::holds(const std::vector<std::size_t>& pairs, const Lmd& lmd) const {
  return std::any_of(pairs.begin(), pairs.end(), [&](std::size_t i) {
    if (pairs_->dimension(i) != 4 || std::abs((*pairs_)[i].distance - lmd.distance) > 2.0 * tolerance_)
      return false;
    const auto on = [&](const Vec3& p, const Triangle& t) {
      return point_triangle_distance(p, t).squared_distance <= tolerance_ * tolerance_;
    };
    return on(lmd.point_moving, moving_.triangle((*pairs_)[i].a)) &&
           on(lmd.point_fixed, fixed_.triangle((*pairs_)[i].b));
  });
}

bool FlatTruth::at_centroid(const ContactArea& area, const Lmd& lmd) const {
  return area.area > 0.0 && (lmd.point_moving - area.centroid_a).norm() <= CENTROID * size_ &&
         (lmd.point_fixed - area.centroid_b).norm() <= CENTROID * size_;
}

bool FlatTruth::is_local_minimum(const Lmd& lmd) const {
  bool holds_it = false;
  for (std::size_t i = 0; i < pairs_->size(); ++i) {
    if (pairs_->dimension(i) != 4) continue;
    const auto on = [&](const Vec3& p, const Triangle& t) {
      return point_triangle_distance(p, t).squared_distance <= 1e-6 * tolerance_ * tolerance_;
    };
    if (!on(lmd.point_moving, moving_.triangle((*pairs_)[i].a)) ||
        !on(lmd.point_fixed, fixed_.triangle((*pairs_)[i].b)))
      continue;
    if ((*pairs_)[i].distance < lmd.distance - tolerance_) return false;
    holds_it = true;
  }
  return holds_it;
}

bool FlatTruth::is_level_place(const Lmd& lmd) const {
  // First with all that the tolerance calls level, then its parts, with climbs between them.
  for (const double climb : {tolerance_, ROUNDING * lmd.distance}) {
    std::vector<bool> seen(pairs_->size(), false);
    for (std::size_t i = 0; i < pairs_->size(); ++i) {
      const double distance = (*pairs_)[i].distance;
      if (seen[i] || std::abs(distance - lmd.distance) > tolerance_ || !exactly_facing(*pairs_, i)) continue;
      const auto level = connected_to(*pairs_, i, distance * (1.0 - ROUNDING), distance + climb);
      for (const std::size_t k : level) seen[k] = true;
      if (at_centroid(contact_area(*pairs_, level), lmd)) return true;
    }
  }
  return false;
}

FlatCounts FlatTruth::judge(const LmdSet& lmds, std::string& objections) const {
  FlatCounts counts;
  counts.poses = 1;
  if (touching_) {
    counts.touching_poses = 1;
    return counts;
  }
  const auto object = [&](std::size_t& count, const std::string& what) {
    ++count;
    objections += "  " + what + "\n";
  };
  std::vector<std::size_t> held(places_.size(), 0);
  for (const Lmd& lmd : lmds) {
    // A basin with a small climb also holds lower points beyond it: take the LMD's own distance.
    const auto nearest_place = [&](auto&& fits) {
      std::size_t nearest = places_.size();
      const auto off = [&](std::size_t i) { return std::abs(places_[i].basin.least - lmd.distance); };
      for (std::size_t i = 0; i < places_.size(); ++i)
        if ((nearest == places_.size() || off(i) < off(nearest)) && fits(places_[i])) nearest = i;
      return nearest;
    };
    // Asked first, as the centroid may be off the contact's own area (the hole of a ring).
    std::size_t place = nearest_place([&](const Place& p) { return at_centroid(p.area, lmd); });
    const bool centred = place < places_.size();
    if (!centred) place = nearest_place([&](const Place& p) { return holds(p.basin.pairs, lmd); });
    if (place < places_.size()) {
      ++held[place];
      const ContactArea& area = places_[place].area;
      if (centred || area.area == 0.0) continue;
      if (area.nearly || places_[place].claim == Claim::OPEN) {
        ++counts.tolerated;
      } else {
        object(counts.misplaced, "off its centroid " +
                                     at(places_[place].basin.least, area.centroid_a, area.centroid_b) + ": " +
                                     describe(lmd));
      }
    } else if (std::abs(lmd.distance - cutoff_) <= MARGIN * tolerance_) {
      ++counts.tolerated;
    } else if (is_local_minimum(lmd) || is_level_place(lmd)) {
      ++counts.with_way_down;
    } else {
      object(counts.untrue, "no local minimum: " + describe(lmd));
    }
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    if (place.claim == Claim::OPEN) {
      ++counts.tolerated;
      continue;
    }
    ++counts.basins;
    counts.areas += place.area.area > 0.0;
    if (held[i] == 1) {
      ++counts.right;
      continue;
    }
    Vec3 p = place.area.centroid_a, q = place.area.centroid_b;
    for (const std::size_t k : place.basin.pairs) {
      if (place.area.area > 0.0 || !(*pairs_)[k].critical) continue;
      p = (*pairs_)[k].p;
      q = (*pairs_)[k].q;
    }
    const std::string where = at(place.basin.least, p, q) +
                              fmt::format(", area {:.3g}, climb {:.3g}", place.area.area, place.basin.climb);
    if (held[i] == 0) object(counts.missed, "missed " + where);
    if (held[i] > 1) object(counts.doubled, fmt::format("{} LMDs ", held[i]) + where);
  }
  counts.right -= std::min(counts.right, counts.misplaced);
  counts.tolerance_poses = counts.tolerated > 0;
  counts.faulty_poses = counts.faults() > 0;
  return counts;
}

}  // namespace lmdbench::exact
