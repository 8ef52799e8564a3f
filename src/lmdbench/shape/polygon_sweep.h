// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>

#include <span>
#include <vector>

namespace lmdbench {

/// A directed side of a polygon, the inside to its left. Each of the polygon's corners begins one.
struct PolygonSide {
  Vec2 from, to;
};

/// Appends the sides of a convex polygon.
void append_sides_of(const ConvexPolygon& polygon, std::vector<PolygonSide>& sides);

/// Cuts a polygon into convex pieces. A line sweeps upwards over its corners; between two of them
/// the inside is a row of trapezoids. A trapezoid is joined to the one below while the piece stays
/// convex (a convex polygon is one piece). Sides may touch, overlap or cross: winding numbers
/// decide.
/// Corners whose heights differ by the tolerance or less begin one row, for all of their sides; the
/// strip between them is skipped.
std::vector<ConvexPolygon> convex_pieces(std::span<const PolygonSide> sides, double tolerance);

/// A connected part of the overlap of two polygons: convex pieces, side by side.
using SharedPart = std::vector<ConvexPolygon>;

/// Overlap of two polygons, by the same sweep over the sides of both; heights at which sides of one
/// cross sides of the other are corners, too. No sides of one polygon may cross. Parts within the
/// tolerance of each other are one. Rounding adds or loses only slivers as narrow as the tolerance.
/// n log n in sides and crossings, times the sides at a height.
std::vector<SharedPart> shared_parts(std::span<const PolygonSide> a, std::span<const PolygonSide> b,
                                     double tolerance);

}  // namespace lmdbench
