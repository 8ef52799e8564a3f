// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/build/polar_cap.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

/// Used by polar_cap.cpp, edge_cap.cpp, polar_extremes.cpp and clear_vertex.cpp alone.
namespace lmdbench::polar {

/// n . direction <= slack for unit n.
struct Constraint {
  Vec3 direction;
  double slack;
};

/// Extreme directions of a polar cone, and the angle [rad] to add to their spread.
struct Extremes {
  std::vector<Vec3> directions;
  double slack = 0.0;
  WingSet wings = 0;  ///< Constraints whose planes cross there.
};

/// Scratch memory of one thread: caps are built for every feature of a mesh.
struct Scratch {
  std::vector<Constraint> constraints;
  std::vector<Constraint> set_aside;  ///< Of the cone of some of them.
  Extremes extremes;
};

/// The thread's, emptied.
Scratch& scratch();

inline constexpr std::size_t NONE = std::numeric_limits<std::size_t>::max();

/// Whether a direction satisfies all constraints but `i` and `j`, each relaxed by `extra`.
bool satisfies(const std::vector<Constraint>& constraints, const Vec3& direction, std::size_t i,
               std::size_t j, double extra);

/// Smallest cap around the directions, widened by the slack; nothing where there are none.
std::optional<PolarCap> cap_around(const Extremes& extremes);

/// Cap of an edge, or of the chain whose lead it is. Of lines no longer than the least wing: all
/// directions.
std::optional<PolarCap> edge_cap(const Surface& surface, std::int32_t edge, const ShapeComplex* shape);

}  // namespace lmdbench::polar
