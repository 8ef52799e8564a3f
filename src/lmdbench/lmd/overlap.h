// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/lmd/contact.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// A connected part of what two polygons share.
struct OverlapPart {
  std::vector<ConvexPolygon> pieces;  ///< Convex, side by side, in the frame of the overlap.
  double area = 0.0;                  ///< m^2
  Vec2 centroid = Vec2::Zero();
};

/// What two regions share, seen along the normal of `frame_W`: each convex piece of one cut by those of the other near it
/// (Sutherland and Hodgman 1974), and the cuts joined where their pieces are neighbours and they touch. Convex cuts
/// cannot go wrong topologically: rounding adds or loses a sliver, and centroids are continuous.
/// The work is that of the pieces that meet.
/// @param rounding  cuts that are no wider are none; cuts that come this near touch [m]
std::vector<OverlapPart> overlap_of_regions(const ShapeSide& moving, std::int32_t region_moving,
                                            const ShapeSide& fixed, std::int32_t region_fixed,
                                            const PlanarFrame& frame_W, double rounding);

/// Parts of a segment of the world that lie in a region, seen along the normal of `frame_W`, by parameters from 0 at
/// its first end to 1.
/// @param rounding  parts that are no longer are none; parts that come this near are one [m]
std::vector<SegmentPart> parts_over_region(const Vec3& begin, const Vec3& end, const ShapeSide& side,
                                           std::int32_t region, const PlanarFrame& frame_W, double rounding);

/// Whether a point of a region's plane lies in the region, or beside it by no more than `reach` [m].
/// @param p_S  in the mesh's frame
bool region_holds(const ShapeSide& side, std::int32_t region, const Vec3& p_S, double reach);

}  // namespace lmdbench
