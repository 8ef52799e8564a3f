// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/segment_kernel.h>
#include <lmdbench/geometry/sorted_triangle.h>
#include <lmdbench/geometry/triangle_distance_steps.h>

#include <algorithm>
#include <limits>

// Steps of prove_by_features:
// - triangles that are far apart for their size: start at the corners farthest towards the other
//   triangle and take the edges from there that lead ahead;
// - else, or where that proves nothing: start from guess_features (triangle_distance_steps.h);
// - solve for the nearest points p, q of these features (corner, edge or face);
// - with d = q - p look for a corner of a beyond p along d, or of b beyond q along -d. If all
//   corners that do not carry the pair are behind by a clear margin, the planes through p and q
//   across d keep the triangles |d| apart: they are disjoint and the pair is the unique minimum.
//   This is a proof; rounding spoils the usual early exit, a slab test along a cross product of
//   edges.
// - the pair must also be nearer than every other pair of the same features by more than rounding.
//
// The order of corners and arguments may change the features tried but not the outcome: a proved
// minimum is unique, and its two points are functions of its features alone.

namespace lmdbench::kernel {
namespace {

/// Tolerances in a clear margin. distance_by_all_candidates takes features that drift apart by one
/// tolerance as parallel and answers with the middle of the overlap; half a clear margin must be
/// far beyond that.
constexpr double CLEARANCE = 16.0;

double squared(double x) {
  return x * x;
}

/// The pair whose proof is asked for.
struct Separation {
  Vec3 point;  ///< of this triangle
  Vec3 d;      ///< to the other's
  double squared_d;
  /// Square of the length below which a corner is neither ahead nor behind: covers the error of d
  /// (a few roundings of the coordinates) and the drift that counts as parallel.
  double squared_margin;
  double squared_rise;  ///< as in PointsOnSegments; infinite for two corners
};

/// The corner at the end of `way` is behind the plane across d by a clear margin; so is the point
/// as far on the way as the pair is from the ends of its features, where other features start.
/// @param squared_scale of the way, which may be longer than the real one
bool is_behind(const Vec3& way, double squared_scale, const Separation& pair) {
  const double ahead = way.dot(pair.d);
  const double squared_ahead = squared(ahead);
  const double squared_way = way.squaredNorm();
  const bool is_clear = squared_ahead > pair.squared_margin * (squared_way + squared_scale * pair.squared_d);
  const bool is_steep =
      squared_ahead * pair.squared_rise > pair.squared_margin * squared_way * pair.squared_d;
  return (ahead < 0.0) & is_clear & is_steep;
}

/// Every corner that does not carry the pair is behind.
bool are_others_behind(const Triangle& t, const Carriers& carriers, const Separation& pair) {
  const Vec3& first = t[carriers.corner[0]];
  switch (carriers.count) {
    case 1: {
      const Vec3& second = t[carriers.corner[0] == 2 ? 0 : carriers.corner[0] + 1];
      const Vec3& third = t[carriers.corner[0] == 0 ? 2 : carriers.corner[0] - 1];
      // Both are computed, because the branch predictor could only guess which one is not behind.
      const bool is_second_behind = is_behind(second - first, 1.0, pair);
      const bool is_third_behind = is_behind(third - first, 1.0, pair);
      return is_second_behind & is_third_behind;
    }
    case 2: {
      // The way to the third corner across the edge, because d along the edge is only rounding;
      // times |e|^2 to save the division. The other edges come as near to the point as it is to
      // their corner, in parts of the edge: the way must be clear at that part, too.
      const Vec3 e = t[carriers.corner[1]] - first;
      const Vec3 way = t[3 - carriers.corner[0] - carriers.corner[1]] - first;
      const double squared_e = e.squaredNorm();
      const Vec3 across = squared_e * way - way.dot(e) * e;
      const double to_end =
          std::min((pair.point - first).squaredNorm(), (pair.point - t[carriers.corner[1]]).squaredNorm());
      const bool is_wide = squared(across.dot(pair.d)) * to_end >
                           pair.squared_margin * squared(squared_e) * squared_e * pair.squared_d;
      return is_wide & is_behind(across, squared(squared_e), pair);
    }
    default:
      return true;
  }
}

/// The choice between two neighbours that are both ahead.
enum class Neighbour { STEEPER, FLATTER };

/// Makes an edge of a corner that has a neighbour ahead along d.
/// @returns false where there is none, or no corner to start from
bool extend(const Triangle& t, Carriers& carriers, const Vec3& d, Neighbour choice) {
  if (carriers.count != 1) return false;
  const int corner = carriers.corner[0];
  const int second = corner == 2 ? 0 : corner + 1;
  const int third = corner == 0 ? 2 : corner - 1;
  const Vec3 to_second = t[second] - t[corner];
  const Vec3 to_third = t[third] - t[corner];
  const double ahead_second = to_second.dot(d);
  const double ahead_third = to_third.dot(d);
  const bool third_is_steeper =
      squared(ahead_third) * to_second.squaredNorm() > squared(ahead_second) * to_third.squaredNorm();
  const bool take_third =
      (ahead_third > 0.0) & ((ahead_second <= 0.0) | (third_is_steeper == (choice == Neighbour::STEEPER)));
  const bool has_edge = (ahead_second > 0.0) | (ahead_third > 0.0);
  carriers.corner[1] = take_third ? third : second;
  carriers.count = has_edge ? 2 : 1;
  return has_edge;
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
  double widening = 1.0;      ///< of the squared margin: the face's shape magnifies rounding
};

/// Nearest points of both triangles' carriers.
struct Pair {
  Vec3 point_a = Vec3::Zero();
  Vec3 point_b = Vec3::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();
  double squared_rise = 0.0;
  double widening = 1.0;

  void set_a(const PointOnPart& part, const Vec3& corner_of_b) {
    set(part);
    point_a = part.point;
    point_b = corner_of_b;
  }
  void set_b(const Vec3& corner_of_a, const PointOnPart& part) {
    set(part);
    point_a = corner_of_a;
    point_b = part.point;
  }

 private:
  void set(const PointOnPart& part) {
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

PointOnPart solve_part_to_corner(const Triangle& t, Carriers& carriers, const Vec3& x, double tolerance) {
  switch (carriers.count) {
    case 1: {
      const Vec3& corner = t[carriers.corner[0]];
      return {corner, (x - corner).squaredNorm()};
    }
    case 2:
      return solve_edge_to_corner(t, carriers, x, tolerance);
    default:
      return solve_face_to_corner(t, carriers, x, tolerance);
  }
}

/// No other pair of points of these features is as near up to rounding: they are not nearly
/// parallel, and the points are not so near an end or border that a lower feature would do.
bool is_clear_minimum(const Pair& pair, double squared_margin) {
  return pair.squared_rise > squared_margin &&
         squared(pair.squared_rise) > squared_margin * pair.squared_distance;
}

int farthest_along(const Triangle& t, const Vec3& direction) {
  const double h0 = t[0].dot(direction), h1 = t[1].dot(direction), h2 = t[2].dot(direction);
  const int first = h1 > h0 ? 1 : 0;
  return h2 > (h1 > h0 ? h1 : h0) ? 2 : first;
}

/// One attempt: the carriers and their nearest points.
struct Attempt {
  Carriers carriers_a, carriers_b;
  Pair pair;

  /// @pre not two faces, nor a face and an edge
  void solve(const Triangle& a, const Triangle& b, double tolerance) {
    if (carriers_a.count == 2 && carriers_b.count == 2) {
      solve_edge_to_edge(a, carriers_a, b, carriers_b, tolerance, pair);
    } else if (carriers_b.count == 1) {
      const Vec3& corner = b[carriers_b.corner[0]];
      pair.set_a(solve_part_to_corner(a, carriers_a, corner, tolerance), corner);
    } else {
      const Vec3& corner = a[carriers_a.corner[0]];
      pair.set_b(corner, solve_part_to_corner(b, carriers_b, corner, tolerance));
    }
  }

  /// @param d from a to b
  bool extend(const Triangle& a, const Triangle& b, const Vec3& d, Neighbour choice) {
    const bool extended_a = carriers_b.count < 3 && kernel::extend(a, carriers_a, d, choice);
    const bool extended_b = carriers_a.count < 3 && kernel::extend(b, carriers_b, -d, choice);
    return extended_a || extended_b;
  }

  bool is_proved(const Triangle& a, const Triangle& b, double squared_margin) const {
    const bool two_corners = carriers_a.count + carriers_b.count == 2;
    const Vec3 d = pair.point_b - pair.point_a;
    Separation separation{pair.point_a, d, pair.squared_distance, squared_margin * pair.widening,
                          two_corners ? std::numeric_limits<double>::infinity() : pair.squared_rise};
    if (!are_others_behind(a, carriers_a, separation)) return false;
    separation.point = pair.point_b;
    separation.d = -d;
    return are_others_behind(b, carriers_b, separation) &&
           (two_corners || is_clear_minimum(pair, squared_margin));
  }

  /// Solves, and stores the result where it is proved.
  bool succeeds(const Triangle& a, const Triangle& b, double tolerance, TrianglePairDistance& result) {
    solve(a, b, tolerance);
    if (!is_proved(a, b, squared(CLEARANCE * tolerance))) return false;
    result.squared_distance = pair.squared_distance;
    result.point_a = pair.point_a;
    result.point_b = pair.point_b;
    result.feature_a = carriers_a.feature();
    result.feature_b = carriers_b.feature();
    result.intersecting = false;
    result.minimiser_dimension = 0;
    result.minimiser_measure = 0.0;
    return true;
  }
};

/// Squared distance of the centres over the summed squares of two edges each, from which on the
/// first step proves most pairs. Changes only the time.
constexpr double FAR_APART = 0.5;

bool are_far_apart(const Triangle& a, const Triangle& b, const Vec3& toward_b) {
  const double squared_sizes = (a[1] - a[0]).squaredNorm() + (a[2] - a[0]).squaredNorm() +
                               (b[1] - b[0]).squaredNorm() + (b[2] - b[0]).squaredNorm();
  return toward_b.squaredNorm() > 9.0 * FAR_APART * squared_sizes;  // the centres, times three
}

}  // namespace

bool prove_by_features(const Triangle& a, const Triangle& b, double tolerance, TrianglePairDistance& result) {
  Attempt attempt;
  const Vec3 toward_b = (b[0] + b[1] + b[2]) - (a[0] + a[1] + a[2]);
  if (are_far_apart(a, b, toward_b)) {
    attempt.carriers_a = Carriers::one(farthest_along(a, toward_b));
    attempt.carriers_b = Carriers::one(farthest_along(b, -toward_b));
    attempt.extend(a, b, b[attempt.carriers_b.corner[0]] - a[attempt.carriers_a.corner[0]],
                   Neighbour::STEEPER);
    if (attempt.succeeds(a, b, tolerance, result)) return true;
  }
  const FeatureGuess guess = guess_features(a, b, COINCIDENCE_TOLERANCE / tolerance);
  if (!guess.exists) return false;
  attempt.carriers_a = guess.on_a;
  attempt.carriers_b = guess.on_b;
  if (attempt.succeeds(a, b, tolerance, result)) return true;
  // Edges at a small angle: single precision may take their crossing for an end. The flatter
  // neighbour runs along the other edge.
  return attempt.extend(a, b, attempt.pair.point_b - attempt.pair.point_a, Neighbour::FLATTER) &&
         attempt.succeeds(a, b, tolerance, result);
}

}  // namespace lmdbench::kernel
