// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/vertex_fan.h>
#include <lmdbench/methods/certified/build/polar_extremes.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

using polar::Constraint, polar::Scratch;

/// Crossings of planes closer to parallel than this (a sine) are left out: their neighbours bound
/// the cone to within the slack (PROOF.md, lemma 4).
constexpr double LEAST_CROSSING = 1e-6;
/// Those that a WingSet has bits for.
constexpr std::size_t MOST_WINGS = std::numeric_limits<WingSet>::digits;
/// Planes at a larger sine cross clearly: most candidates are rejected without a root.
constexpr double CLEAR_CROSSING = 0.2;
/// Which of the crossings x and -x of two planes some constraint surely rejects (not those two
/// planes'). |x| is at least CLEAR_CROSSING and at most 1; no constraint has more slack than
/// POLAR_SLACK.
std::array<bool, 2> clearly_rejected(const std::vector<Constraint>& constraints, const Vec3& x) {
  // Planes that cross at such an angle shift their crossing by less than 2 / CLEAR_CROSSING slacks.
  constexpr double LIMIT = (1.0 + 2.0 / CLEAR_CROSSING) * POLAR_SLACK;
  double highest = 0.0, lowest = 0.0;
  for (const Constraint& constraint : constraints) {
    const double along = constraint.direction.dot(x);
    highest = std::max(highest, along);
    lowest = std::min(lowest, along);
    if (highest > LIMIT && lowest < -LIMIT) break;
  }
  return {highest > LIMIT, -lowest > LIMIT};
}

/// Crossings of two constraints' planes that satisfy all others. False when no two planes cross.
bool find_crossings(Scratch& work) {
  const std::size_t count = work.constraints.size();
  work.extremes.directions.clear();
  work.extremes.slack = 0.0;
  work.extremes.wings = 0;
  bool crossed = false;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3& a = work.constraints[i].direction;
      const Vec3& b = work.constraints[j].direction;
      Vec3 crossing = a.cross(b);
      const double squared_sine = crossing.squaredNorm();
      if (squared_sine < LEAST_CROSSING * LEAST_CROSSING) continue;
      crossed = true;
      std::array<bool, 2> rejected{};
      if (squared_sine > CLEAR_CROSSING * CLEAR_CROSSING)
        rejected = clearly_rejected(work.constraints, crossing);
      if (rejected[0] && rejected[1]) continue;
      const double sine = std::sqrt(squared_sine);
      crossing /= sine;
      // Relaxed planes cross at most this far from the exact ones: s / cos(half their angle).
      const double half_cosine = std::sqrt(std::max(0.0, 0.5 * (1.0 + a.dot(b))));
      const double shift = POLAR_SLACK / std::max(half_cosine, LEAST_CROSSING);
      for (const std::size_t sign : {0u, 1u}) {
        const Vec3 candidate = sign == 0 ? crossing : Vec3(-crossing);
        if (rejected[sign] || !polar::satisfies(work.constraints, candidate, i, j, shift)) continue;
        work.extremes.directions.push_back(candidate);
        work.extremes.slack = std::max(work.extremes.slack, POLAR_SLACK + shift);
        if (j < MOST_WINGS) work.extremes.wings |= 1u << i | 1u << j;
      }
    }
  }
  return crossed;
}

/// As find_crossings where only some constraints bound the cone: their crossings satisfy all
/// others, so all that lies between them does. @return whether they do
bool find_crossings_of_some(Scratch& work, WingSet wings) {
  if (work.constraints.size() > MOST_WINGS) return false;
  std::vector<Constraint>& all = work.set_aside;
  all.clear();
  std::swap(all, work.constraints);
  for (WingSet left = wings; left != 0; left &= left - 1)
    if (const auto i = static_cast<std::size_t>(std::countr_zero(left)); i < all.size())
      work.constraints.push_back(all[i]);
  const bool crossed = find_crossings(work);
  work.extremes.wings = wings;
  std::swap(all, work.constraints);
  return crossed && std::ranges::all_of(work.extremes.directions, [&](const Vec3& direction) {
           return polar::satisfies(work.constraints, direction, polar::NONE, polar::NONE,
                                   work.extremes.slack);
         });
}

/// Up to so many directions all crossings are tried; of more, those of a subset.
constexpr std::size_t FEW_DIRECTIONS = 128;

/// Like `find_crossings`, in time linear in the number of constraints (PROOF.md, lemma 5). Of many
/// only the outermost are taken, and then those that the crossings so far violate most, until none
/// is violated by more than twice its slack or there are enough. `work.constraints` is the subset
/// then. Fewer constraints leave a larger set: the cap holds the whole cone, and is empty only
/// where that is.
bool find_crossings_of_many(Scratch& work) {
  if (work.constraints.size() <= FEW_DIRECTIONS) return find_crossings(work);
  const std::vector<Constraint> all = std::exchange(work.constraints, {});
  std::vector<bool> taken(all.size(), false);
  const auto farthest_along = [&](const Vec3& n) {
    return static_cast<std::size_t>(std::max_element(all.begin(), all.end(),
                                                     [&](const Constraint& a, const Constraint& b) {
                                                       return a.direction.dot(n) < b.direction.dot(n);
                                                     }) -
                                    all.begin());
  };
  const auto take = [&](std::size_t i) {
    if (!taken[i]) work.constraints.push_back(all[i]);
    taken[i] = true;
  };
  for (const int x : {-1, 0, 1})
    for (const int y : {-1, 0, 1})
      for (const int z : {-1, 0, 1}) take(farthest_along(Vec3(x, y, z)));
  while (true) {
    if (!find_crossings(work)) return false;
    const std::size_t before = work.constraints.size();
    if (before > FEW_DIRECTIONS) return true;
    for (const Vec3& crossing : work.extremes.directions) {
      const std::size_t worst = farthest_along(crossing);
      if (all[worst].direction.dot(crossing) > 2.0 * POLAR_SLACK) take(worst);
    }
    if (work.constraints.size() == before) return true;
  }
}

std::optional<PolarCap> vertex_cap(const Surface& surface, std::int32_t vertex, const ShapeComplex* shape,
                                   WingSet* bounding) {
  if (surface.adjacency.vertex_triangles[vertex].empty()) return std::nullopt;
  Scratch& work = polar::scratch();
  const double least_wing = shape != nullptr ? LEAST_WING * shape->regions.extent : 0.0;
  const auto constrain = [&](const Vec3& wing) {
    const double length = wing.norm();
    if (length > least_wing) work.constraints.push_back({wing / length, POLAR_SLACK});
    return true;
  };
  if (shape != nullptr) {
    shape->for_each_corner_wing(surface, vertex, constrain);
  } else {
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(vertex)];
    for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
      return constrain(surface.mesh.vertices[static_cast<std::size_t>(neighbour)] - p);
    });
  }
  const bool are_known = bounding != nullptr && *bounding != 0 && find_crossings_of_some(work, *bounding);
  if (!are_known && !find_crossings_of_many(work)) return PolarCap{};
  if (bounding != nullptr) *bounding = work.extremes.wings;
  if (work.extremes.directions.empty()) return std::nullopt;
  if (!surface.is_one_fan({FeatureKind::VERTEX, vertex})) return polar::cap_around(work.extremes);
  // Of saddles and peaks no direction has to be dropped, of pits each. What lies above, or clearly
  // below, every triangle lies so by their mean normal, which costs more to make.
  bool all_above = true, all_below = true;
  const double clearly_below = -(POLAR_SLACK + 2.0 * work.extremes.slack);
  for (const std::int32_t t : surface.adjacency.vertex_triangles[vertex]) {
    const Vec3& normal = surface.face_normals[static_cast<std::size_t>(t)];
    if (normal.isZero(0.0)) continue;
    for (const Vec3& direction : work.extremes.directions) {
      const double height = normal.dot(direction);
      all_above = all_above && height > 0.0;
      all_below = all_below && height < clearly_below;
    }
  }
  if (all_above) return polar::cap_around(work.extremes);
  if (all_below) return std::nullopt;
  const Vec3 outer = surface.vertex_normal(vertex);
  if (!outer.isZero(0.0) && std::ranges::any_of(work.extremes.directions, [&](const Vec3& direction) {
        return direction.dot(outer) < 0.0;
      })) {
    work.constraints.push_back({-outer, POLAR_SLACK});
    find_crossings(work);
  }
  return polar::cap_around(work.extremes);
}

}  // namespace

std::optional<PolarCap> polar_cap(const Surface& surface, const FeatureId& feature, const ShapeComplex* shape,
                                  WingSet* bounding) {
  const auto of_normal = [](const Vec3& normal) {
    return PolarCap{normal, 1.0 - 0.5 * PARALLEL_SLACK * PARALLEL_SLACK, PARALLEL_SLACK};
  };
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return vertex_cap(surface, feature.index, shape, bounding);
    case FeatureKind::EDGE:
      return polar::edge_cap(surface, feature.index, shape);
    case FeatureKind::FACE:
      break;
  }
  const Vec3& normal = surface.face_normals[static_cast<std::size_t>(feature.index)];
  if (normal.isZero(0.0)) return std::nullopt;
  if (shape == nullptr || shape->region_of(feature.index) < 0) return of_normal(normal);
  return of_normal(shape->regions.planes[static_cast<std::size_t>(shape->region_of(feature.index))].normal);
}

}  // namespace lmdbench
