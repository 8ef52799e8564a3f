// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/mesh/surface.h>

#include <cstdint>

namespace lmdbench {

/// Local tracking (paper, sections 3.2.2 and 4.2): an LMD moves to its local minimum over
/// neighbouring triangles.
///   L1  the triangles round both contact points, by their closest features (Fig. 5);
///   L2  the distances of all combinations;
///   L3  quit when the shortest one is the pair that was there;
///   L4  else go on from the shortest.
///
/// The distance of a triangle pair (7x7 points or exact) and its origin (calculated or cached) are
/// the algorithm's own; the walk is shared.

/// Closest points of one triangle pair, as an algorithm sees them.
struct TrackedPair {
  Lmd lmd;                     ///< Without `direction`.
  bool seen_by_other = false;  ///< Calculated in this update for another LMD (section 4.2.1).
};

/// Where a walk ended.
struct WalkEnd {
  Lmd lmd;
  bool is_duplicate =
      false;  ///< The minimum was already found for another LMD: the published rule drops this one.
};

/// A distance is shorter only by more than this fraction: the same points, seen from another
/// triangle that shares them, differ by rounding. Useful range 1e-14 .. 1e-9.
inline constexpr double SAME_DISTANCE_TOLERANCE = 1e-12;

inline bool is_shorter(double candidate, double best) {
  return candidate < best * (1.0 - SAME_DISTANCE_TOLERANCE);
}

/// Direction of a pair from its points; at distance 0 it keeps the last valid one (decision E12).
inline void set_direction(Lmd& lmd, const Vec3& last_direction) {
  lmd.direction = lmd.distance > 0.0 && !lmd.intersecting
                      ? Vec3((lmd.point_fixed - lmd.point_moving) / lmd.distance)
                      : last_direction;
}

/// L1 as in Fig. 5 (b) and (c): the triangles that contain the feature. A face is its own alone.
struct IncidentTriangles {
  TriangleList operator()(const Surface& surface, const FeatureId& feature) const {
    return surface.incident_triangles(feature);
  }
};

/// L2: the shortest of all combinations of two neighbourhoods' triangles.
/// @param evaluate (triangle_moving, triangle_fixed) -> TrackedPair at the current pose
template <class Evaluate>
TrackedPair shortest_pair(const TriangleList& moving, const TriangleList& fixed, Evaluate&& evaluate) {
  TrackedPair shortest;
  bool any = false;
  for (const std::int32_t t_moving : moving) {
    for (const std::int32_t t_fixed : fixed) {
      const TrackedPair pair = evaluate(t_moving, t_fixed);
      if (!any || is_shorter(pair.lmd.distance, shortest.lmd.distance)) {
        shortest = pair;
        any = true;
      } else if (!is_shorter(shortest.lmd.distance, pair.lmd.distance)) {
        // The same minimum on another triangle that shares its features.
        shortest.seen_by_other |= pair.seen_by_other;
      }
    }
  }
  return shortest;
}

/// Walks an LMD to its local minimum. Of pairs at one distance the one that is there stays
/// (decision E14, ours): flat faces at rest have many such, and an LMD that moves between them
/// wanders.
/// @param start the LMD as it was found or tracked last
/// @param there its triangles or points at the current pose
/// @param look  L1 and L2: (feature_moving, feature_fixed) -> the shortest TrackedPair round them
/// @param steps rounds of L1..L4, is added to
template <class Look>
WalkEnd walk_by(const Lmd& start, const Lmd& there, Look&& look, std::uint64_t& steps) {
  WalkEnd end{there, false};
  for (Lmd looked_round = start;; looked_round = end.lmd) {
    ++steps;
    const TrackedPair shortest = look(looked_round.feature_moving, looked_round.feature_fixed);
    end.is_duplicate = shortest.seen_by_other;
    if (is_shorter(shortest.lmd.distance, end.lmd.distance)) end.lmd = shortest.lmd;
    if (end.is_duplicate || same_feature_pair(end.lmd, looked_round)) break;
  }
  set_direction(end.lmd, start.direction);
  return end;
}

/// The same, looking at each pair of triangles.
/// @param evaluate   as `shortest_pair` takes it
/// @param neighbours (surface, feature) -> TriangleList of L1
template <class Evaluate, class Neighbours = IncidentTriangles>
WalkEnd walk_to_minimum(const Surface& moving, const Surface& fixed, const Lmd& start, const Lmd& there,
                        Evaluate&& evaluate, std::uint64_t& steps, Neighbours&& neighbours = {}) {
  const auto look = [&](const FeatureId& feature_moving, const FeatureId& feature_fixed) {
    return shortest_pair(neighbours(moving, feature_moving), neighbours(fixed, feature_fixed), evaluate);
  };
  return walk_by(start, there, look, steps);
}

}  // namespace lmdbench
