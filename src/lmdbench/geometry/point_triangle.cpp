// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/segment_kernel.h>
#include <lmdbench/geometry/sorted_triangle.h>
#include <lmdbench/geometry/tolerance.h>

#include <array>

namespace lmdbench {

PointTriangleDistance point_triangle_distance(const Vec3& point, const Triangle& triangle) {
  const kernel::SortedTriangle sorted(triangle);
  const std::array<Vec3, 4> points{point, triangle[0], triangle[1], triangle[2]};
  const double tolerance = coincidence_length(largest_coordinate(points));
  PointTriangleDistance best;
  const kernel::FaceFrame frame(sorted.corners, tolerance);
  if (frame.has_face) {
    const auto weights = frame.weights(point);
    if (frame.is_interior(weights)) {
      best.point = frame.point(weights);
      best.squared_distance = (point - best.point).squaredNorm();
      return best;
    }
  }
  best.squared_distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto& ends = kernel::EDGE_ENDS[k];
    const kernel::PointOnSegment candidate =
        kernel::project_on_segment(point, sorted.corners[ends[0]], sorted.corners[ends[1]], tolerance);
    const TriangleFeature feature = sorted.edge_part(k, candidate.feature);
    const bool nearer = candidate.squared_distance < best.squared_distance;
    const bool tie = candidate.squared_distance == best.squared_distance;
    if (nearer || (tie && is_vertex(feature) && !is_vertex(best.feature))) {
      best = {candidate.squared_distance, candidate.point, feature};
    }
  }
  return best;
}

}  // namespace lmdbench
