// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/feature_descent.h>
#include <lmdbench/geometry/segment_kernel.h>
#include <lmdbench/geometry/sorted_triangle.h>

#include <array>
#include <cmath>
#include <limits>

// Steps of feature_descent:
// - start at the nearest pair of corners;
// - solve for the nearest points p, q of the parts of the triangles that the carriers span (corner, edge or
// face);
// - with d = q - p look for a corner of a beyond p along d, or of b beyond q along -d. If every corner that
// does not
//   carry the pair is behind by a clear margin, the plane through p across d and the one through q keep the
//   triangles apart by |d|: the pair is the minimum, it is unique, and the triangles are disjoint. This is a
//   proof, not the slab test along a cross product of edges whose rounding makes the usual early exit of such
//   kernels go wrong.
// - the pair must also be nearer than every other pair of the same features by more than rounding;
// - otherwise the corner that is farthest ahead joins the carriers; every step brings the points nearer.
//
// The path may depend on the order of corners and arguments; its outcome does not, because a proved minimum
// is unique and its two points come from functions of its features alone.

namespace lmdbench::kernel {
namespace {

/// How many tolerances make a margin clear. The examination of all candidates takes an overlap of features
/// that drift apart by one tolerance as parallel and answers by its middle; half a clear margin must still be
/// far beyond that.
constexpr double CLEARANCE = 16.0;

/// Generic pairs need three steps or fewer; the bound only stops a cycle that rounding could keep alive.
constexpr int MAX_STEPS = 6;

/// The corners whose hull carries the current point of one triangle.
struct Carriers {
  std::array<int, 3> corner{};
  int count = 0;

  static Carriers one(int k) {
    Carriers result;
    result.add(k);
    return result;
  }
  static Carriers two(int k, int l) {
    Carriers result = one(k);
    result.add(l);
    return result;
  }
  void add(int k) { corner[count++] = k; }
  void keep_only(int k) {
    corner[0] = k;
    count = 1;
  }
};

/// What the corners outside the carriers say about the direction.
struct Outlook {
  bool all_behind = true;  ///< every corner is behind by the margin
  int ahead = -1;          ///< the corner ahead by the margin with the steepest way to it; -1 for none
};

double squared(double x) {
  return x * x;
}

/// @param d from this triangle to the other
/// @param squared_margin square of the length below which a corner is neither ahead nor behind: it covers the
///   error of d (a few roundings of the coordinates) and the drift that counts as parallel
Outlook look_out(const Triangle& t, const Carriers& carriers, const Vec3& d, double squared_d,
                 double squared_margin) {
  Outlook outlook;
  double steepest = 0.0, squared_way_of_steepest = 1.0;
  const auto judge = [&](int corner, const Vec3& way, double squared_scale) {
    const double ahead = way.dot(d);
    const double squared_way = way.squaredNorm();
    const bool clear = squared(ahead) > squared_margin * (squared_way + squared_scale * squared_d);
    outlook.all_behind &= clear && ahead < 0.0;
    if (clear && ahead > 0.0 && squared(ahead) * squared_way_of_steepest > steepest * squared_way) {
      steepest = squared(ahead);
      squared_way_of_steepest = squared_way;
      outlook.ahead = corner;
    }
  };
  const int first = carriers.corner[0];
  if (carriers.count == 1) {
    const int second = first == 2 ? 0 : first + 1;
    const int third = 3 - first - second;
    judge(second, t[second] - t[first], 1.0);
    judge(third, t[third] - t[first], 1.0);
  } else if (carriers.count == 2) {
    // The way to the third corner across the edge: along the edge d says nothing but rounding. Times |e|^2,
    // which saves the division.
    const int corner = 3 - first - carriers.corner[1];
    const Vec3 e = t[carriers.corner[1]] - t[first];
    const Vec3 way = t[corner] - t[first];
    const double squared_e = e.squaredNorm();
    judge(corner, squared_e * way - way.dot(e) * e, squared(squared_e));
  }
  return outlook;
}

/// Ends of the edge between two carriers, lower first.
struct OrderedEdge {
  int low, high;
  OrderedEdge(const Triangle& t, const Carriers& carriers) {
    const bool turn = lexicographic_less(t[carriers.corner[1]], t[carriers.corner[0]]);
    low = carriers.corner[turn ? 1 : 0];
    high = carriers.corner[turn ? 0 : 1];
  }
};

void reduce(Carriers& carriers, const OrderedEdge& edge, SegmentFeature feature) {
  if (feature == SegmentFeature::V0) carriers.keep_only(edge.low);
  if (feature == SegmentFeature::V1) carriers.keep_only(edge.high);
}

/// Nearest point of one triangle's carriers to a corner of the other triangle.
struct PointOnPart {
  Vec3 point;
  double squared_distance = std::numeric_limits<double>::infinity();
  double squared_rise = 0.0;  ///< as in PointsOnSegments
  double widening = 1.0;      ///< factor on the squared margin: how badly the face's shape magnifies rounding
};

/// Nearest points of both triangles' carriers.
struct Pair {
  Vec3 point_a = Vec3::Zero();
  Vec3 point_b = Vec3::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();
  double squared_rise = 0.0;
  double widening = 1.0;

  void set(const Vec3& on_a, const Vec3& on_b, const PointOnPart& part) {
    point_a = on_a;
    point_b = on_b;
    squared_distance = part.squared_distance;
    squared_rise = part.squared_rise;
    widening = part.widening;
  }
};

/// Drops carriers that do not carry the point.
PointOnPart solve_edge_to_corner(const Triangle& t, Carriers& carriers, const Vec3& x, double tolerance) {
  const OrderedEdge edge(t, carriers);
  const PointOnSegment nearest = project_on_segment(x, t[edge.low], t[edge.high], tolerance);
  reduce(carriers, edge, nearest.feature);
  return {nearest.point, nearest.squared_distance, nearest.squared_rise};
}

void solve_edge_to_edge(const Triangle& a, Carriers& carriers_a, const Triangle& b, Carriers& carriers_b,
                        double tolerance, Pair& pair) {
  const OrderedEdge edge_a(a, carriers_a);
  const OrderedEdge edge_b(b, carriers_b);
  PointsOnSegments nearest;
  const bool a_first =
      segment_pair(a[edge_a.low], a[edge_a.high], b[edge_b.low], b[edge_b.high], tolerance, nearest);
  reduce(carriers_a, edge_a, a_first ? nearest.feature_p : nearest.feature_q);
  reduce(carriers_b, edge_b, a_first ? nearest.feature_q : nearest.feature_p);
  pair.point_a = a_first ? nearest.p : nearest.q;
  pair.point_b = a_first ? nearest.q : nearest.p;
  pair.squared_distance = nearest.squared_distance;
  pair.squared_rise =
      nearest.squared_rise;  // 0 for overlapping parallel edges: they have no single nearest pair
  pair.widening = 1.0;
}

PointOnPart solve_face_to_corner(const Triangle& t, Carriers& carriers, const Vec3& x, double tolerance) {
  const SortedTriangle sorted(t);
  const FaceFrame frame(sorted.corners, tolerance);
  const auto weights = frame.weights(x);
  PointOnPart best;
  if (frame.has_face && frame.is_interior(weights)) {
    best.point = frame.point(weights);
    best.squared_distance = (x - best.point).squaredNorm();
    best.squared_rise = frame.squared_distance_to_border(weights);
    best.widening = 1.0 + (frame.squared_e + best.squared_distance) / frame.squared_h;
    return best;
  }
  for (int k = 0; k < 3; ++k) {
    Carriers edge = Carriers::two(k, (k + 1) % 3);
    const PointOnPart candidate = solve_edge_to_corner(t, edge, x, tolerance);
    if (candidate.squared_distance < best.squared_distance) {
      best = candidate;
      carriers = edge;
    }
  }
  return best;
}

/// Nearest points of the face of t and an edge of the other triangle; false where the edge seems to pierce
/// the face. Which pair of parts to try is a guess in plain arithmetic: a wrong guess costs time, never an
/// answer.
bool solve_face_to_edge(const Triangle& t, Carriers& carriers_t, const Triangle& other,
                        Carriers& carriers_other, double tolerance, Pair& pair) {
  const OrderedEdge edge(other, carriers_other);
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double height_low = normal.dot(other[edge.low] - t[0]);
  const double height_high = normal.dot(other[edge.high] - t[0]);
  // Nearest to the plane is an end of the edge, or the point where it crosses the plane.
  const bool crosses = !(height_low * height_high > 0.0);
  const int nearer = std::abs(height_low) < std::abs(height_high) ? edge.low : edge.high;
  Vec3 nearest_to_plane = other[nearer];
  if (crosses) {
    const double part = height_low / (height_low - height_high);
    nearest_to_plane = other[edge.low] + part * (other[edge.high] - other[edge.low]);
  }
  std::array<bool, 3> is_beyond;  // edge k, which joins corners k and k + 1
  for (int k = 0; k < 3; ++k) {
    const Vec3& from = t[k];
    is_beyond[k] = !(normal.dot((t[(k + 1) % 3] - from).cross(nearest_to_plane - from)) > 0.0);
  }
  if (!is_beyond[0] && !is_beyond[1] && !is_beyond[2]) {
    if (crosses) return false;
    carriers_other.keep_only(nearer);
    const PointOnPart part = solve_face_to_corner(t, carriers_t, other[nearer], tolerance);
    pair.set(part.point, other[nearer], part);
    return true;
  }
  Pair best;
  Carriers best_t = carriers_t;
  Carriers best_other = carriers_other;
  for (int k = 0; k < 3; ++k) {
    if (!is_beyond[k]) continue;
    Carriers side = Carriers::two(k, (k + 1) % 3);
    Carriers end = carriers_other;
    Pair candidate;
    solve_edge_to_edge(t, side, other, end, tolerance, candidate);
    if (candidate.squared_distance < best.squared_distance) {
      best = candidate;
      best_t = side;
      best_other = end;
    }
  }
  if (!std::isfinite(best.squared_distance)) return false;
  pair = best;
  carriers_t = best_t;
  carriers_other = best_other;
  return true;
}

TriangleFeature feature_of(const Carriers& carriers) {
  switch (carriers.count) {
    case 1:
      return vertex_feature(carriers.corner[0]);
    case 2:
      return edge_feature((4 - carriers.corner[0] - carriers.corner[1]) % 3);
    default:
      return TriangleFeature::FACE;
  }
}

/// No other pair of points of the same features is as near up to rounding: the features are not nearly
/// parallel, and the points are not so near an end or a border that a lower feature would do.
bool is_clear_minimum(const Pair& pair, double squared_margin) {
  return pair.squared_rise > squared_margin &&
         squared(pair.squared_rise) > squared_margin * pair.squared_distance;
}

int farthest_along(const Triangle& t, const Vec3& direction) {
  const double h0 = t[0].dot(direction), h1 = t[1].dot(direction), h2 = t[2].dot(direction);
  const int first = h1 > h0 ? 1 : 0;
  return h2 > (h1 > h0 ? h1 : h0) ? 2 : first;
}

}  // namespace

bool feature_descent(const Triangle& a, const Triangle& b, double tolerance, TrianglePairDistance& result) {
  const Vec3 toward_b = (b[0] + b[1] + b[2]) - (a[0] + a[1] + a[2]);
  const int start_a = farthest_along(a, toward_b);
  const int start_b = farthest_along(b, -toward_b);
  Carriers carriers_a = Carriers::one(start_a);
  Carriers carriers_b = Carriers::one(start_b);
  Pair pair;
  pair.point_a = a[start_a];
  pair.point_b = b[start_b];
  pair.squared_distance = (pair.point_b - pair.point_a).squaredNorm();
  const double squared_margin = squared(CLEARANCE * tolerance);
  for (int step = 0; step < MAX_STEPS; ++step) {
    const Vec3 d = pair.point_b - pair.point_a;
    const double margin = squared_margin * pair.widening;
    const Outlook from_a = look_out(a, carriers_a, d, pair.squared_distance, margin);
    const Outlook from_b = look_out(b, carriers_b, -d, pair.squared_distance, margin);
    if (from_a.all_behind && from_b.all_behind) {
      const bool two_corners = carriers_a.count + carriers_b.count == 2;
      if (!two_corners && !is_clear_minimum(pair, squared_margin)) return false;
      result.squared_distance = pair.squared_distance;
      result.point_a = pair.point_a;
      result.point_b = pair.point_b;
      result.feature_a = feature_of(carriers_a);
      result.feature_b = feature_of(carriers_b);
      result.intersecting = false;
      result.minimiser_dimension = 0;
      result.minimiser_measure = 0.0;
      return true;
    }
    if (from_a.ahead >= 0) carriers_a.add(from_a.ahead);
    // Two faces at once have no closed form; the face of a and the edge of b do, and b's corner can still
    // come.
    if (from_b.ahead >= 0 && carriers_a.count + carriers_b.count < 5) carriers_b.add(from_b.ahead);
    if (from_a.ahead < 0 && from_b.ahead < 0) return false;
    if (carriers_a.count == 2 && carriers_b.count == 2) {
      solve_edge_to_edge(a, carriers_a, b, carriers_b, tolerance, pair);
    } else if (carriers_b.count == 1) {
      const Vec3& corner = b[carriers_b.corner[0]];
      const PointOnPart part = carriers_a.count == 2 ? solve_edge_to_corner(a, carriers_a, corner, tolerance)
                                                     : solve_face_to_corner(a, carriers_a, corner, tolerance);
      pair.set(part.point, corner, part);
    } else if (carriers_a.count == 1) {
      const Vec3& corner = a[carriers_a.corner[0]];
      const PointOnPart part = carriers_b.count == 2 ? solve_edge_to_corner(b, carriers_b, corner, tolerance)
                                                     : solve_face_to_corner(b, carriers_b, corner, tolerance);
      pair.set(corner, part.point, part);
    } else if (carriers_b.count == 2) {
      if (!solve_face_to_edge(a, carriers_a, b, carriers_b, tolerance, pair)) return false;
    } else if (carriers_a.count == 2) {
      if (!solve_face_to_edge(b, carriers_b, a, carriers_a, tolerance, pair)) return false;
      std::swap(pair.point_a, pair.point_b);
    } else {
      return false;  // two faces that face each other: contact, parallel, or nearly so
    }
  }
  return false;
}

}  // namespace lmdbench::kernel
