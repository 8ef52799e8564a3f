// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace lmdbench {

/// Where a surface touches or crosses itself.
struct SelfIntersections {
  std::int64_t pairs = 0;  ///< Pairs that share a point beyond a common corner or side.
  std::optional<std::array<std::int32_t, 2>> first;  ///< The least pair, smaller index first.
  bool complete = true;  ///< All pairs were tested; else `pairs` is a lower bound.
};

/// Pairs tested before the search gives up: hubs of thousands of needles would take hours.
inline constexpr std::int64_t MOST_SELF_PAIRS = 20'000'000;

/// Tests every pair of triangles whose boxes overlap, by a tree of boxes over the triangles (median
/// split along the axis of the largest spread of centres over box size). Exact, by signs of
/// determinants (`triangle_intersection.h`), to tell neighbours, which touch anyway, from folds:
///  - no common corner: they share any point;
///  - one: the opposite side of one shares a point with the other triangle;
///  - two: they lie in one plane, on the same side of the common edge;
///  - three: they are duplicates, which the validity report counts.
/// Corners at the same place are the same corner, whatever their numbers. Triangles without area
/// are skipped; the validity report counts them.
/// @param most_pairs to test
SelfIntersections self_intersections(const TriangleMesh& mesh, std::int64_t most_pairs = MOST_SELF_PAIRS);

/// A clause for people.
std::string to_text(const SelfIntersections& found);

}  // namespace lmdbench
