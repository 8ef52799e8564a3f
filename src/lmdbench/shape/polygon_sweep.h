// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>

#include <span>
#include <vector>

namespace lmdbench {

/// A directed side of a polygon, the inside to its left.
struct PolygonSide {
  Vec2 from, to;
};

/// Cuts a polygon into convex pieces: a line sweeps upwards over its corners; between two of them the inside
/// is a row of trapezoids, and one that goes on in the next row is joined to it while the piece stays convex
/// (so a convex polygon is one piece). Sides may touch or lie on each other: what counts is how often a point
/// is wound round. Corners whose heights differ by no more than the tolerance are level, and what is between
/// them is left out.
std::vector<ConvexPolygon> convex_pieces(std::span<const PolygonSide> sides, double tolerance);

/// A connected part of what two polygons share: convex pieces, side by side.
using SharedPart = std::vector<ConvexPolygon>;

/// What two polygons share, by the same sweep over the sides of both; the heights at which sides cross are corners, too. Parts
/// that come within the tolerance of each other are one. Rounding adds or loses slivers as narrow as the tolerance and
/// nothing else. n log n in the sides and their crossings, times the sides that a height meets.
std::vector<SharedPart> shared_parts(std::span<const PolygonSide> a, std::span<const PolygonSide> b,
                                     double tolerance);

}  // namespace lmdbench
