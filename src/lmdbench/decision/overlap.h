// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/geometry/convex_polygon.h>

#include <boost/container/small_vector.hpp>

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

/// A frame square to a direction, for the sweep over the overlap of two regions. Its first axis is
/// that of the region of more pieces: then pieces on top of each other share level sides.
PlanarFrame frame_of_overlap(const ShapeSide& moving, std::int32_t region_moving, const ShapeSide& fixed,
                             std::int32_t region_fixed, const Vec3& point, const Vec3& n);

/// What two regions share, seen along the normal of `frame_W` (frame_of_overlap): one sweep over
/// both borders (polygon_sweep.h), of a large region only over pieces near the other one. Rounding
/// adds or loses no more than a sliver; centroids are continuous.
/// @param rounding  no narrower part counts; parts that come this near touch [m]
std::vector<OverlapPart> overlap_of_regions(const ShapeSide& moving, std::int32_t region_moving,
                                            const ShapeSide& fixed, std::int32_t region_fixed,
                                            const PlanarFrame& frame_W, double rounding);

/// Nearly always one part.
using SegmentParts = boost::container::small_vector<SegmentPart, 4>;

/// Parts of a segment in a region's plane that lie in the region, by parameters from 0 to 1.
/// @param begin_S, end_S  frame of the region's mesh
/// @param rounding  no shorter part counts; parts that come this near are one [m]
SegmentParts parts_over_region(const Vec3& begin_S, const Vec3& end_S, const ShapeSide& side,
                               std::int32_t region, double rounding);

/// Whether a point of the plane of a face lies in it, or beside it by no more than `within` [m].
/// @param n_S  the plane's normal; frame of the mesh, as p_S is
bool is_on_face(const ShapeSide& side, const Vec3& n_S, std::int32_t face, const Vec3& p_S, double within);

/// Calls visit(face) for a region's faces that hold a point of its plane (is_on_face), until false.
/// @return whether visit never returned false
template <class Visit>
bool for_each_face_at(const ShapeSide& side, std::int32_t region, const Vec3& p_S, double within,
                      Visit&& visit) {
  const Vec3& n = side.shape.regions.planes[static_cast<std::size_t>(region)].normal;
  const auto look_at = [&](std::int32_t face) {
    return !is_on_face(side, n, face, p_S, within) || visit(face);
  };
  const RegionShape* shape = side.shape.shapes.of_region(region);
  if (shape == nullptr) return look_at(side.shape.lead_of_region(region));
  Box2 box;
  box.add(shape->frame.flat(p_S));
  return side.shape.for_each_face_near(region, box, within, look_at);
}

}  // namespace lmdbench
