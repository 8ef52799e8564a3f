// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/certified_descent.h>
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/segment_kernel.h>
#include <lmdbench/geometry/sorted_triangle.h>

#include <array>
#include <cmath>
#include <limits>

// Steps of certified_descent:
// - start at the nearest pair of corners;
// - solve for the nearest points p, q of the parts of the triangles that the carriers span (corner, edge or
// face);
// - with d = q - p look for a corner of a beyond p along d, or of b beyond q along -d. If every corner that
// does not
//   carry the pair is behind by a clear margin, the plane through p across d and the one through q keep the
//   triangles apart by |d|: the pair is the minimum, it is unique, and the triangles are disjoint. This is a
//   proof, not the slab test along a cross product of edges whose rounding makes the usual early exit of such
//   kernels go wrong.
// - otherwise the corner that is farthest ahead joins the carriers; every step brings the points nearer.
//
// Every number is the same for every order of corners and arguments, so is the path and its outcome.

namespace lmdbench::kernel {
namespace {

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
/// error
///   of d (a few roundings of the coordinates) and the drift that counts as parallel
Outlook look_out(const Triangle& t, const Carriers& carriers, const Vec3& d, double squared_d,
                 double squared_margin) {
  Outlook outlook;
  double steepest = 0.0;
  const auto judge = [&](int corner, const Vec3& way) {
    const double ahead = way.dot(d);
    const double squared_way = way.squaredNorm();
    const bool clear = squared(ahead) > squared_margin * (squared_way + squared_d);
    if (!(clear && ahead < 0.0)) outlook.all_behind = false;
    if (clear && ahead > 0.0 && squared(ahead) > steepest * squared_way) {
      steepest = squared(ahead) / squared_way;
      outlook.ahead = corner;
    }
  };
  const int first = carriers.corner[0];
  if (carriers.count == 1) {
    for (int step = 1; step < 3; ++step) {
      const int corner = (first + step) % 3;
      judge(corner, t[corner] - t[first]);
    }
  } else if (carriers.count == 2) {
    // The way to the third corner across the edge: along the edge d says nothing but rounding.
    const int corner = 3 - first - carriers.corner[1];
    const Vec3 e = t[carriers.corner[1]] - t[first];
    const Vec3 way = t[corner] - t[first];
    judge(corner, way - (way.dot(e) / e.squaredNorm()) * e);
  }
  return outlook;
}

/// Ends of the edge between two carriers, lower first.
struct OrderedEdge {
  int low, high;
  OrderedEdge(const Triangle& t, const Carriers& carriers)
      : low(carriers.corner[0]), high(carriers.corner[1]) {
    if (lexicographic_less(t[high], t[low])) std::swap(low, high);
  }
};

void reduce(Carriers& carriers, const OrderedEdge& edge, SegmentFeature feature) {
  if (feature == SegmentFeature::V0) carriers.keep_only(edge.low);
  if (feature == SegmentFeature::V1) carriers.keep_only(edge.high);
}

struct Pair {
  Vec3 point_a = Vec3::Zero();
  Vec3 point_b = Vec3::Zero();
  double squared_distance = 0.0;
  double widening = 1.0;  ///< factor on the squared margin: how badly the face's shape magnifies rounding
};

/// Nearest point of an edge of t to x; drops carriers that do not carry it.
void solve_edge_to_corner(const Triangle& t, Carriers& carriers, const Vec3& x, double tolerance, Vec3& point,
                          double& squared_distance) {
  const OrderedEdge edge(t, carriers);
  const PointSegmentDistance nearest = project_on_segment(x, t[edge.low], t[edge.high], tolerance);
  reduce(carriers, edge, nearest.feature);
  point = nearest.point;
  squared_distance = nearest.squared_distance;
}

void solve_edge_to_edge(const Triangle& a, Carriers& carriers_a, const Triangle& b, Carriers& carriers_b,
                        double tolerance, Pair& pair) {
  const OrderedEdge edge_a(a, carriers_a);
  const OrderedEdge edge_b(b, carriers_b);
  const SegmentPairDistance nearest =
      segment_pair(a[edge_a.low], a[edge_a.high], b[edge_b.low], b[edge_b.high], tolerance);
  reduce(carriers_a, edge_a, nearest.feature_a);
  reduce(carriers_b, edge_b, nearest.feature_b);
  pair.point_a = nearest.point_a;
  pair.point_b = nearest.point_b;
  // Overlapping parallel edges have no single nearest pair: not a number keeps every margin from being met.
  pair.squared_distance =
      nearest.minimiser_dimension == 0 ? nearest.squared_distance : std::numeric_limits<double>::quiet_NaN();
}

void solve_face_to_corner(const Triangle& t, Carriers& carriers, const Vec3& x, double tolerance, Vec3& point,
                          double& squared_distance, double& widening) {
  const SortedTriangle sorted(t);
  const FaceFrame frame(sorted.corners, tolerance);
  const auto weights = frame.weights(x);
  if (frame.has_face && frame.is_interior(weights)) {
    point = frame.point(weights);
    squared_distance = (x - point).squaredNorm();
    widening = 1.0 + (frame.squared_e + squared_distance) / frame.squared_h;
    return;
  }
  squared_distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    Carriers edge = Carriers::two(k, (k + 1) % 3);
    Vec3 candidate;
    double candidate_squared = 0.0;
    solve_edge_to_corner(t, edge, x, tolerance, candidate, candidate_squared);
    if (candidate_squared < squared_distance) {
      squared_distance = candidate_squared;
      point = candidate;
      carriers = edge;
    }
  }
}

/// Nearest points of the face of t and an edge of the other triangle; false where the edge pierces the face.
bool solve_face_to_edge(const Triangle& t, Carriers& carriers_t, const Triangle& other,
                        Carriers& carriers_other, double tolerance, Pair& pair) {
  const SortedTriangle sorted(t);
  const FaceFrame frame(sorted.corners, tolerance);
  if (!frame.has_face) return false;
  const OrderedEdge edge(other, carriers_other);
  const Vec3 normal = frame.e.cross(frame.h);
  const double height_low = normal.dot(other[edge.low] - frame.a);
  const double height_high = normal.dot(other[edge.high] - frame.a);
  if (std::abs(height_low) == std::abs(height_high)) return false;  // parallel, or the order would decide
  const bool low_is_nearer = std::abs(height_low) < std::abs(height_high);
  if (height_low * height_high > 0.0) {
    // Over the face, the end nearer to the plane is the nearest point of the edge.
    const int nearer = low_is_nearer ? edge.low : edge.high;
    const auto weights = frame.weights(other[nearer]);
    if (frame.is_interior(weights)) {
      carriers_other.keep_only(nearer);
      pair.point_a = frame.point(weights);
      pair.point_b = other[nearer];
      pair.squared_distance = (pair.point_a - pair.point_b).squaredNorm();
      pair.widening = 1.0 + (frame.squared_e + pair.squared_distance) / frame.squared_h;
      return true;
    }
  } else {
    const double part = height_low / (height_low - height_high);
    if (frame.is_interior(frame.weights(other[edge.low] + part * (other[edge.high] - other[edge.low]))))
      return false;
  }
  Pair best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  Carriers best_t = carriers_t;
  Carriers best_other = carriers_other;
  for (int k = 0; k < 3; ++k) {
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
  if (!std::isfinite(best.squared_distance)) return false;  // overlaps of parallel edges alone
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

}  // namespace

std::optional<TrianglePairDistance> certified_descent(const Triangle& a, const Triangle& b,
                                                      double tolerance) {
  int start_a = 0, start_b = 0;
  double least = std::numeric_limits<double>::infinity();
  bool tie = false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double squared_distance = (b[j] - a[i]).squaredNorm();
      tie = squared_distance < least ? false : tie | (squared_distance == least);
      start_a = squared_distance < least ? i : start_a;
      start_b = squared_distance < least ? j : start_b;
      least = squared_distance < least ? squared_distance : least;
    }
  }
  if (tie) return std::nullopt;  // the order of the corners would decide
  Carriers carriers_a = Carriers::one(start_a);
  Carriers carriers_b = Carriers::one(start_b);
  Pair pair;
  pair.point_a = a[start_a];
  pair.point_b = b[start_b];
  pair.squared_distance = least;
  const double squared_margin = 2.0 * tolerance * tolerance;
  for (int step = 0; step < MAX_STEPS; ++step) {
    const Vec3 d = pair.point_b - pair.point_a;
    const double margin = squared_margin * pair.widening;
    const Outlook from_a = look_out(a, carriers_a, d, pair.squared_distance, margin);
    const Outlook from_b = look_out(b, carriers_b, -d, pair.squared_distance, margin);
    if (from_a.all_behind && from_b.all_behind) {
      TrianglePairDistance result;
      result.squared_distance = pair.squared_distance;
      result.point_a = pair.point_a;
      result.point_b = pair.point_b;
      result.feature_a = feature_of(carriers_a);
      result.feature_b = feature_of(carriers_b);
      return result;
    }
    if (from_a.ahead >= 0) carriers_a.add(from_a.ahead);
    if (from_b.ahead >= 0) carriers_b.add(from_b.ahead);
    if (from_a.ahead < 0 && from_b.ahead < 0) return std::nullopt;
    pair.widening = 1.0;
    if (carriers_a.count == 2 && carriers_b.count == 2) {
      solve_edge_to_edge(a, carriers_a, b, carriers_b, tolerance, pair);
    } else if (carriers_b.count == 1) {
      pair.point_b = b[carriers_b.corner[0]];
      if (carriers_a.count == 2) {
        solve_edge_to_corner(a, carriers_a, pair.point_b, tolerance, pair.point_a, pair.squared_distance);
      } else {
        solve_face_to_corner(a, carriers_a, pair.point_b, tolerance, pair.point_a, pair.squared_distance,
                             pair.widening);
      }
    } else if (carriers_a.count == 1) {
      pair.point_a = a[carriers_a.corner[0]];
      if (carriers_b.count == 2) {
        solve_edge_to_corner(b, carriers_b, pair.point_a, tolerance, pair.point_b, pair.squared_distance);
      } else {
        solve_face_to_corner(b, carriers_b, pair.point_a, tolerance, pair.point_b, pair.squared_distance,
                             pair.widening);
      }
    } else if (carriers_b.count == 2) {
      if (!solve_face_to_edge(a, carriers_a, b, carriers_b, tolerance, pair)) return std::nullopt;
    } else if (carriers_a.count == 2) {
      if (!solve_face_to_edge(b, carriers_b, a, carriers_a, tolerance, pair)) return std::nullopt;
      std::swap(pair.point_a, pair.point_b);
    } else {
      return std::nullopt;  // two faces that face each other: contact, parallel, or nearly so
    }
  }
  return std::nullopt;
}

}  // namespace lmdbench::kernel
