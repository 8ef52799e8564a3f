// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/planar_overlap.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/segment_kernel.h>
#include <lmdbench/geometry/sorted_triangle.h>
#include <lmdbench/geometry/triangle_distance_steps.h>
#include <lmdbench/geometry/triangle_intersection.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Steps of distance_by_all_candidates:
// - sort the corners of each triangle and the triangles: the caller's order cannot change a bit;
// - triangles that cross by a margin: the answer is the middle of the segment that they share;
// - an exact intersection test for the others; the same answer where they share a clear segment;
// - 9 edge pairs and 6 corner-face pairs, each a feasible pair of points; keep the nearest;
// - where a parallel edge and face, or parallel faces, are as near: take the middle of the overlap.
//
// Every candidate is feasible, so an error in one may lose it but never reports a distance that is
// too small. The candidates cover each other: near the border of two cases both are within rounding
// of the minimum.

namespace lmdbench::kernel {
namespace {

int dimension(TriangleFeature feature) {
  return is_face(feature) ? 2 : is_edge(feature) ? 1 : 0;
}

/// Nearer, or equally near and of lower dimension.
bool better(const TrianglePairDistance& candidate, const TrianglePairDistance& best) {
  if (candidate.squared_distance != best.squared_distance) {
    return candidate.squared_distance < best.squared_distance;
  }
  return dimension(candidate.feature_a) + dimension(candidate.feature_b) <
         dimension(best.feature_a) + dimension(best.feature_b);
}

/// Nearer, or equally near and longer: for overlaps of parallel edges.
bool nearer(const TrianglePairDistance& candidate, const TrianglePairDistance& best) {
  if (candidate.squared_distance != best.squared_distance) {
    return candidate.squared_distance < best.squared_distance;
  }
  return candidate.minimiser_measure > best.minimiser_measure;
}

struct Query {
  const SortedTriangle &a, &b;
  FaceFrame face_a, face_b;
  double tolerance;

  Query(const SortedTriangle& sorted_a, const SortedTriangle& sorted_b, double coincidence)
      : a(sorted_a),
        b(sorted_b),
        face_a(sorted_a.corners, coincidence),
        face_b(sorted_b.corners, coincidence),
        tolerance(coincidence) {}
};

std::array<double, 3> squared_edges(const Triangle& t) {
  return {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[2] - t[0]).squaredNorm()};
}

/// The nearest edge pair, and the longest overlap of parallel edges if there is one.
struct EdgePairs {
  TrianglePairDistance nearest;
  TrianglePairDistance overlap;
};

EdgePairs examine_edge_pairs(const Query& query) {
  EdgePairs result;
  result.nearest.squared_distance = std::numeric_limits<double>::infinity();
  result.overlap.squared_distance = std::numeric_limits<double>::infinity();
  const std::array<double, 3> squared_a = squared_edges(query.a.corners);
  const std::array<double, 3> squared_b = squared_edges(query.b.corners);
  for (int i = 0; i < 3; ++i) {
    const Vec3& a0 = query.a.corners[EDGE_ENDS[i][0]];
    const Vec3& a1 = query.a.corners[EDGE_ENDS[i][1]];
    for (int j = 0; j < 3; ++j) {
      PointsOnSegments pair;
      const bool a_first =
          segment_pair(a0, a1, squared_a[i], query.b.corners[EDGE_ENDS[j][0]],
                       query.b.corners[EDGE_ENDS[j][1]], squared_b[j], query.tolerance, pair);
      if (pair.squared_distance > result.nearest.squared_distance && pair.overlap_length == 0.0) continue;
      TrianglePairDistance candidate;
      candidate.squared_distance = pair.squared_distance;
      candidate.point_a = a_first ? pair.p : pair.q;
      candidate.point_b = a_first ? pair.q : pair.p;
      candidate.feature_a = query.a.edge_part(i, a_first ? pair.feature_p : pair.feature_q);
      candidate.feature_b = query.b.edge_part(j, a_first ? pair.feature_q : pair.feature_p);
      candidate.minimiser_dimension = pair.overlap_length > 0.0 ? 1 : 0;
      candidate.minimiser_measure = pair.overlap_length;
      if (better(candidate, result.nearest)) result.nearest = candidate;
      if (candidate.minimiser_dimension == 1 && nearer(candidate, result.overlap)) result.overlap = candidate;
    }
  }
  return result;
}

TrianglePairDistance nearest_corner_of_a_to_face_of_b(const SortedTriangle& a, const FaceFrame& face_b) {
  TrianglePairDistance best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (!face_b.has_face) return best;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3& x = a.corners[corner];
    const auto weights = face_b.weights(x);
    if (!face_b.is_interior(weights)) continue;
    TrianglePairDistance candidate;
    candidate.point_a = x;
    candidate.point_b = face_b.point(weights);
    candidate.squared_distance = (candidate.point_a - candidate.point_b).squaredNorm();
    candidate.feature_a = a.vertex(corner);
    candidate.feature_b = TriangleFeature::FACE;
    if (better(candidate, best)) best = candidate;
  }
  return best;
}

TrianglePairDistance swapped(const TrianglePairDistance& pair) {
  TrianglePairDistance result = pair;
  std::swap(result.point_a, result.point_b);
  std::swap(result.feature_a, result.feature_b);
  return result;
}

/// Signed heights of three corners over the plane of a face.
Vec3 heights_over(const FaceFrame& face, const Triangle& corners) {
  const Vec3 normal = face.unit_normal();
  return {normal.dot(corners[0] - face.a), normal.dot(corners[1] - face.a), normal.dot(corners[2] - face.a)};
}

/// The longest overlap of an edge of a with the face of b that is as near as `best`.
void prefer_edge_over_face(const SortedTriangle& a, const FaceFrame& face_b, const Vec3& heights,
                           double tolerance, double limit, TrianglePairDistance& best) {
  for (int k = 0; k < 3; ++k) {
    const int i = EDGE_ENDS[k][0];
    const int j = EDGE_ENDS[k][1];
    if (!(std::abs(heights[i] - heights[j]) <= tolerance)) continue;
    if (!(std::min(std::abs(heights[i]), std::abs(heights[j])) <= limit)) continue;
    const auto overlap = edge_over_face(a.corners[i], a.corners[j], face_b, tolerance);
    if (!overlap.exists) continue;
    TrianglePairDistance candidate;
    candidate.point_a = overlap.middle_on_edge;
    candidate.point_b = overlap.middle_on_face;
    candidate.squared_distance = (candidate.point_a - candidate.point_b).squaredNorm();
    candidate.feature_a = a.edge(k);
    candidate.feature_b = TriangleFeature::FACE;
    candidate.minimiser_dimension = 1;
    candidate.minimiser_measure = overlap.length;
    if (!(std::sqrt(candidate.squared_distance) <= limit)) continue;
    if (best.minimiser_dimension < 1 || candidate.minimiser_measure > best.minimiser_measure)
      best = candidate;
  }
}

/// Replaces a single nearest pair by the middle of an overlap of parallel features that is as near.
void prefer_whole_minimiser_set(const Query& query, const TrianglePairDistance& edge_overlap,
                                TrianglePairDistance& best) {
  const double limit = std::sqrt(best.squared_distance) + query.tolerance;
  if (query.face_a.has_face && query.face_b.has_face) {
    const Vec3 z = heights_over(query.face_a, query.b.corners);
    if (z.maxCoeff() - z.minCoeff() <= query.tolerance && z.cwiseAbs().minCoeff() <= limit) {
      const auto overlap = face_over_face(query.face_a, query.face_b, query.tolerance);
      const double squared_distance = (overlap.centroid_on_first - overlap.centroid_on_second).squaredNorm();
      if (overlap.exists && std::sqrt(squared_distance) <= limit) {
        best.point_a = overlap.centroid_on_first;
        best.point_b = overlap.centroid_on_second;
        best.squared_distance = squared_distance;
        best.feature_a = best.feature_b = TriangleFeature::FACE;
        best.minimiser_dimension = 2;
        best.minimiser_measure = overlap.area;
        return;
      }
    }
  }
  if (std::sqrt(edge_overlap.squared_distance) <= limit) best = edge_overlap;
  if (query.face_b.has_face) {
    prefer_edge_over_face(query.a, query.face_b, heights_over(query.face_b, query.a.corners), query.tolerance,
                          limit, best);
  }
  if (query.face_a.has_face) {
    TrianglePairDistance turned = swapped(best);
    prefer_edge_over_face(query.b, query.face_a, heights_over(query.face_a, query.b.corners), query.tolerance,
                          limit, turned);
    best = swapped(turned);
  }
}

TrianglePairDistance shared_point(const Vec3& point, double length, double tolerance) {
  TrianglePairDistance result;
  result.squared_distance = 0.0;
  result.point_a = result.point_b = point;
  result.intersecting = true;
  if (length > tolerance) {
    result.minimiser_dimension = 1;
    result.minimiser_measure = length;
  }
  return result;
}

/// The triangles cross by a margin, the middle of the shared segment inside both: the usual
/// intersection, which needs no exact predicates.
bool is_certain_crossing(const Query& query, const SharedSegment& shared) {
  if (!query.face_a.has_face || !query.face_b.has_face || !shared.is_certain) return false;
  const Vec3 middle = shared.middle();
  return query.face_a.is_interior(query.face_a.weights(middle)) &&
         query.face_b.is_interior(query.face_b.weights(middle));
}

/// The shared point with the features that carry it; at a corner, a copy of the corner.
TrianglePairDistance shared_point_on_features(const Query& query, const Vec3& point, double length) {
  const auto on_a = point_triangle_distance(point, query.a.corners);
  const auto on_b = point_triangle_distance(point, query.b.corners);
  TrianglePairDistance result = shared_point(is_vertex(on_a.feature)   ? on_a.point
                                             : is_vertex(on_b.feature) ? on_b.point
                                                                       : point,
                                             length, query.tolerance);
  result.feature_a = query.a.original_feature(on_a.feature);
  result.feature_b = query.b.original_feature(on_b.feature);
  return result;
}

/// The triangles' planes differ, so intersecting triangles share no polygon.
bool have_different_planes(const Query& query) {
  if (!query.face_a.has_face || !query.face_b.has_face) return true;
  const Vec3 z = heights_over(query.face_a, query.b.corners);
  return z.maxCoeff() - z.minCoeff() > query.tolerance;
}

/// The answer for any triangles that share a point: the middle of the shared set.
TrianglePairDistance answer_intersection(const Query& query, const SharedSegment& shared,
                                         const TrianglePairDistance& nearest) {
  // For touching or coplanar triangles the nearest pair is the middle of the shared set already.
  const bool is_polygon =
      nearest.minimiser_dimension == 2 && std::sqrt(nearest.squared_distance) <= query.tolerance;
  const bool touching = nearest.squared_distance <= 4.0 * query.tolerance * query.tolerance;
  if (!is_polygon && shared.is_clear && (!touching || shared.length > query.tolerance)) {
    return shared_point_on_features(query, shared.middle(), shared.length);
  }
  TrianglePairDistance result = shared_point_on_features(query, nearest.point_a, 0.0);
  result.minimiser_dimension = nearest.minimiser_dimension;
  result.minimiser_measure = nearest.minimiser_measure;
  return result;
}

/// @pre a before b in lexicographic order of sorted corners
TrianglePairDistance ordered_distance(const SortedTriangle& a, const SortedTriangle& b, double tolerance) {
  const Query query(a, b, tolerance);
  const SharedSegment shared = shared_segment(a.corners, query.face_a, b.corners, query.face_b);
  if (is_certain_crossing(query, shared)) return shared_point(shared.middle(), shared.length, tolerance);
  const bool intersecting = triangles_intersect(a.corners, b.corners);
  if (intersecting && shared.is_clear && shared.length > tolerance && have_different_planes(query)) {
    return shared_point_on_features(query, shared.middle(), shared.length);
  }
  const EdgePairs edge_pairs = examine_edge_pairs(query);
  TrianglePairDistance best = edge_pairs.nearest;
  const TrianglePairDistance on_b = nearest_corner_of_a_to_face_of_b(a, query.face_b);
  if (better(on_b, best)) best = on_b;
  const TrianglePairDistance on_a = swapped(nearest_corner_of_a_to_face_of_b(b, query.face_a));
  if (better(on_a, best)) best = on_a;
  prefer_whole_minimiser_set(query, edge_pairs.overlap, best);
  return intersecting ? answer_intersection(query, shared, best) : best;
}

}  // namespace

TrianglePairDistance distance_by_all_candidates(const Triangle& a, const Triangle& b, double tolerance) {
  const SortedTriangle sorted_a(a);
  const SortedTriangle sorted_b(b);
  const bool b_first =
      std::lexicographical_compare(sorted_b.corners.begin(), sorted_b.corners.end(), sorted_a.corners.begin(),
                                   sorted_a.corners.end(), lexicographic_less);
  const TrianglePairDistance result =
      ordered_distance(b_first ? sorted_b : sorted_a, b_first ? sorted_a : sorted_b, tolerance);
  return b_first ? swapped(result) : result;
}

}  // namespace lmdbench::kernel
