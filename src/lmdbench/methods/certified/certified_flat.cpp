// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/certified/touch.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

/// The part of `certified` that knows regions and straight edges (flat_mesh.h). What the filter leaves of a
/// pair of them is either a parallel contact, found whole (flat_contacts.h), or it has at most one candidate
/// point, like a pair of faces or edges: then the faces or edges at that point decide in their place.
namespace lmdbench {

namespace {

/// Sines of angles between edges: below the first they may be parallel (as in the filter), above the second
/// they cross in one place.
constexpr double NEARLY_PARALLEL_SINE = 1e-4;
constexpr double CROSSING_SINE = 1e-8;
/// Sine by which a direction leaves an edge's cone clearly: ten times what the truth grants to a piece of a plateau.
constexpr double CLEARLY_OUTSIDE = 10.0 * PLATEAU_PIECE_TOLERANCE;
/// How far a direction between points may be off, times the touch distance over its length: 16 epsilon of the coordinates.
constexpr double DIRECTION_ROUNDING = 4e-6;
/// Directions of edges that pass each other and differ by more than this, as a sine, are left to the triangles.
constexpr double LARGEST_TURN_ALONG = 1e-2;
/// A feature with more times the corners of the other one is not held against the other's plane
/// (scripts/tuned_constants.py --only FEW_CORNERS experiments/extreme/gears.json).
constexpr std::size_t FEW_CORNERS = 4;
/// Of features with more pairs of corners the sides are not tried as separating axes, because the triangles that are near each
/// other may be fewer (scripts/tuned_constants.py --only MOST_CORNER_PAIRS experiments/extreme/peg-square.json).
constexpr std::size_t MOST_CORNER_PAIRS = 64;

std::int32_t region_of(const FlatSide& side, const FeatureId& face) {
  return side.mesh.regions->region_of_triangle[static_cast<std::size_t>(face.index)];
}

std::int32_t straight_of(const FlatSide& side, const FeatureId& edge) {
  return side.mesh.regions->straight_of_edge[static_cast<std::size_t>(edge.index)];
}

Segment whole_edge(const FlatSide& side, const FeatureId& edge) {
  const auto& ends =
      side.mesh.regions->straight_edges[static_cast<std::size_t>(straight_of(side, edge))].ends;
  return {side.vertex(ends[0]), side.vertex(ends[1])};
}

/// Calls visit(edge) for the edge at a place of a straight edge (0 at its first end, 1 at the other), and for
/// its neighbours, which rounding may mean.
template <class Visit>
void for_each_edge_at(const FlatSide& side, std::int32_t straight, double place, Visit visit) {
  const auto edges = side.mesh.regions->edges_of_straight[straight];
  const auto& ends = side.mesh.regions->straight_edges[static_cast<std::size_t>(straight)].ends;
  const auto vertex = [&](std::int32_t v) -> const Vec3& {
    return side.surface.mesh.vertices[static_cast<std::size_t>(v)];
  };
  const Vec3 u = vertex(ends[1]) - vertex(ends[0]);
  // Where an edge but the first begins: at the vertex that it shares with the one before.
  const auto begin_of = [&](std::size_t k) {
    const auto& own = side.surface.adjacency.edges[static_cast<std::size_t>(edges[k])];
    const auto& before = side.surface.adjacency.edges[static_cast<std::size_t>(edges[k - 1])];
    const std::int32_t shared = own[0] == before[0] || own[0] == before[1] ? own[0] : own[1];
    return (vertex(shared) - vertex(ends[0])).dot(u) / u.squaredNorm();
  };
  std::size_t low = 0, high = edges.size();  // the edge is in [low, high)
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (begin_of(middle) <= place ? low : high) = middle;
  }
  for (std::size_t k = low > 0 ? low - 1 : 0; k < std::min(low + 2, edges.size()); ++k) visit(edges[k]);
}

/// Calls visit(face) for the faces of a region near the box of some points of the world.
template <class Visit>
void for_each_face_near(const FlatSide& side, std::int32_t region, std::span<const Vec3> points_W,
                        double reach, Visit visit) {
  const RegionShape* shape = side.mesh.shapes.of_region(region);
  if (shape == nullptr) {
    visit(side.mesh.lead_of_region(region));
    return;
  }
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p_W : points_W) {
    const Vec2 x = shape->frame.flat(side.X_WS.rotation.transpose() * (p_W - side.X_WS.translation));
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  shape->for_each_near(low, high, reach, visit);
}

/// Whether a direction leaves an edge's polar cone at all points from p0 to p1, by more than the truth grants: how far a corner
/// is over the plane square to the direction does not depend on the point, and what is granted for it is most at an end.
/// @param spare  sine by which the direction may be off
bool leaves_cone(const FlatSide& side, std::int32_t edge, const Vec3& p0, const Vec3& p1, const Vec3& d_W,
                 double touch, double spare) {
  const FeatureId feature{FeatureKind::EDGE, edge};
  const double tolerance = CLEARLY_OUTSIDE + DIRECTION_ROUNDING * touch / d_W.norm() + spare;
  // Turned to the outer side: which side a direction along it is on is a matter of rounding.
  const Vec3 m_W = side.X_WS.direction(side.surface.pseudo_normal(feature));
  const Vec3 turned_W = d_W + tolerance * d_W.norm() * m_W;
  const auto is_outside = [&](const Vec3& p) {
    return !in_outward_polar_cone(side.surface, side.X_WS, feature, p, turned_W, 2.0 * tolerance);
  };
  return is_outside(p0) && is_outside(p1);
}

/// Whether an edge that is parallel to a plane, and clear of it, has no minimum inside over that plane.
/// @param ends_W of the edge
bool has_none_over(const FlatSide& side, std::int32_t edge, const std::array<Vec3, 2>& ends_W,
                   const Plane& plane, double touch) {
  const Vec3 u = ends_W[1] - ends_W[0];
  const double height = std::min(plane.height(ends_W[0]), plane.height(ends_W[1]));
  if (height <= 2.0 * touch) return false;
  const Vec3 n = -(plane.normal - u.dot(plane.normal) / u.squaredNorm() * u).normalized();
  return leaves_cone(side, edge, ends_W[0], ends_W[1], height * n, touch, 0.0);
}

/// Whether two edges have no minimum inside both: they share nothing along each other, or are parallel and clear of each other,
/// and the direction leaves the cone of one.
bool have_none_inside(const FlatSide& moving, std::int32_t edge_moving, const FlatSide& fixed,
                      std::int32_t edge_fixed, double touch) {
  const auto ends_of = [](const FlatSide& side, std::int32_t edge) {
    const auto& ends = side.surface.adjacency.edges[static_cast<std::size_t>(edge)];
    return Segment{side.vertex(ends[0]), side.vertex(ends[1])};
  };
  const Segment a = ends_of(moving, edge_moving), b = ends_of(fixed, edge_fixed);
  const Vec3 u = a[1] - a[0], v = b[1] - b[0];
  // What both share along the moving edge, from 0 to 1 on it.
  const auto place_of = [&](const Vec3& x) { return (x - a[0]).dot(u) / u.squaredNorm(); };
  const double place0 = place_of(b[0]), place1 = place_of(b[1]);
  const double begin = std::max(0.0, std::min(place0, place1)), end = std::min(1.0, std::max(place0, place1));
  // The direction of a minimum inside both is square to both: where they share nothing, their ends answer.
  if (!(end > begin)) return (begin - end) * u.norm() > 2.0 * touch;
  const auto on_moving = [&](double s) { return Vec3(a[0] + s * u); };
  const auto on_fixed = [&](double s) { return Vec3(b[0] + (s - place0) / (place1 - place0) * v); };
  const Vec3 p0 = on_moving(begin), p1 = on_moving(end), q0 = on_fixed(begin), q1 = on_fixed(end);
  const double nearest = std::min((q0 - p0).norm(), (q1 - p1).norm());
  // Edges that pass each other have a direction at each place.
  const double turn = ((q1 - p1) - (q0 - p0)).norm() / nearest;
  if (nearest <= 2.0 * touch || turn > LARGEST_TURN_ALONG) return false;
  const Vec3 d = 0.5 * ((q0 - p0) + (q1 - p1));
  return leaves_cone(moving, edge_moving, p0, p1, d - d.dot(u) / u.squaredNorm() * u, touch, 2.0 * turn) ||
         leaves_cone(fixed, edge_fixed, q0, q1, -(d - d.dot(v) / v.squaredNorm() * v), touch, 2.0 * turn);
}

/// Gap between a feature's corners and a plane, with the axis from the feature towards it.
ClearGap gap_to(const Plane& plane, const FlatSide& side, std::span<const std::int32_t> corners) {
  Extent heights;
  for (const std::int32_t corner : corners) heights.add(plane.height(side.vertex(corner)));
  return heights.least >= -heights.greatest ? ClearGap{heights.least, -plane.normal}
                                            : ClearGap{-heights.greatest, plane.normal};
}

/// Largest gap between two regions along the products of a side of one and a side of the other: with their own planes the
/// separating axes of convex polygons. Walls of a box that stands over a box are separated by no plane of theirs.
ClearGap gap_along_side_products(const FlatSide& moving, std::int32_t region_moving,
                                 std::span<const Vec3> corners_moving, const FlatSide& fixed,
                                 std::int32_t region_fixed, std::span<const Vec3> corners_fixed) {
  const auto sides_m = moving.mesh.regions->straight_edges_of_region[region_moving];
  const auto sides_f = fixed.mesh.regions->straight_edges_of_region[region_fixed];
  ClearGap widest;
  const auto side_of = [](const FlatSide& side, std::int32_t straight) {
    const auto& ends = side.mesh.regions->straight_edges[static_cast<std::size_t>(straight)].ends;
    return Vec3(side.vertex(ends[1]) - side.vertex(ends[0]));
  };
  for (const std::int32_t s : sides_m) {
    const Vec3 u = side_of(moving, s);
    for (const std::int32_t t : sides_f) {
      const Vec3 product = u.cross(side_of(fixed, t));
      const double length = product.norm();
      if (!(length > 0.0)) continue;
      const Vec3 axis = product / length;
      const Extent of_moving = extent_along(corners_moving, axis),
                   of_fixed = extent_along(corners_fixed, axis);
      const double ahead = of_fixed.least - of_moving.greatest, behind = of_moving.least - of_fixed.greatest;
      if (ahead > widest.gap) widest = {ahead, axis};
      if (behind > widest.gap) widest = {behind, -axis};
    }
  }
  return widest;
}

}  // namespace

/// Whether the pair is settled; else it is one of single features, and its triangles decide.
bool Certified::decide_flat(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                            WorkCounters& counters) {
  const bool joined =
      frame.flat_moving.mesh.is_joined(on_moving) || frame.flat_fixed.mesh.is_joined(on_fixed);
  const FeatureKind kind_m = on_moving.kind, kind_f = on_fixed.kind;
  if (kind_m == FeatureKind::VERTEX || kind_f == FeatureKind::VERTEX)
    return decide_vertex(frame, on_moving, on_fixed, joined, counters);
  if (kind_m == FeatureKind::FACE && kind_f == FeatureKind::FACE) {
    const std::int32_t a = region_of(frame.flat_moving, on_moving), b = region_of(frame.flat_fixed, on_fixed);
    if (contacts_.add_faces(frame.flat_moving, a, frame.flat_fixed, b) == FlatVerdict::UNSURE)
      expand_faces(frame, a, b);
    return true;
  }
  if (kind_m == FeatureKind::FACE || kind_f == FeatureKind::FACE) {
    if (contacts_.contact_of(frame.flat_moving, on_moving, frame.flat_fixed, on_fixed) != nullptr)
      return true;
    const bool forward = kind_m == FeatureKind::EDGE;
    const FlatSide& of_edge = forward ? frame.flat_moving : frame.flat_fixed;
    const FlatSide& of_face = forward ? frame.flat_fixed : frame.flat_moving;
    const std::int32_t straight = straight_of(of_edge, forward ? on_moving : on_fixed);
    const std::int32_t region = region_of(of_face, forward ? on_fixed : on_moving);
    if (contacts_.add_edge_face(of_edge, straight, of_face, region) == FlatVerdict::UNSURE)
      expand_edge_face(frame, of_edge, straight, of_face, region);
    return true;
  }
  return decide_edges(frame, on_moving, on_fixed, joined, counters);
}

bool Certified::decide_edges(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                             bool joined, WorkCounters& counters) {
  const Segment a = whole_edge(frame.flat_moving, on_moving), b = whole_edge(frame.flat_fixed, on_fixed);
  const Vec3 u = a[1] - a[0], v = b[1] - b[0], r = a[0] - b[0];
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double sine = u.cross(v).norm() / std::sqrt(uu * vv);
  if (sine > NEARLY_PARALLEL_SINE) {
    // The common perpendicular of edges of two faces in contact is the contact's direction.
    if (contacts_.contact_of(frame.flat_moving, on_moving, frame.flat_fixed, on_fixed) != nullptr)
      return true;
  } else {
    const std::int32_t s = straight_of(frame.flat_moving, on_moving);
    const std::int32_t t = straight_of(frame.flat_fixed, on_fixed);
    const FlatVerdict verdict = contacts_.add_edges(frame.flat_moving, s, frame.flat_fixed, t);
    if (verdict == FlatVerdict::UNSURE) expand_edges(frame, s, t);
    if (verdict != FlatVerdict::NONE || sine <= CROSSING_SINE) return true;
  }
  if (!joined) return false;
  const double determinant = uu * vv - uv * uv, ur = u.dot(r), vr = v.dot(r);
  const double place_a = (uv * vr - vv * ur) / determinant, place_b = (uu * vr - uv * ur) / determinant;
  for_each_edge_at(
      frame.flat_moving, straight_of(frame.flat_moving, on_moving), place_a, [&](std::int32_t i) {
        for_each_edge_at(frame.flat_fixed, straight_of(frame.flat_fixed, on_fixed), place_b,
                         [&](std::int32_t j) {
                           decide_single(frame, {FeatureKind::EDGE, i}, {FeatureKind::EDGE, j}, counters);
                         });
      });
  return true;
}

bool Certified::decide_vertex(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                              bool joined, WorkCounters& counters) {
  const bool forward = on_moving.kind == FeatureKind::VERTEX;
  const FeatureId& vertex = forward ? on_moving : on_fixed;
  const FeatureId& other = forward ? on_fixed : on_moving;
  const FlatSide& of_vertex = forward ? frame.flat_moving : frame.flat_fixed;
  const FlatSide& of_other = forward ? frame.flat_fixed : frame.flat_moving;
  const auto decide_with = [&](const FeatureId& feature) {
    decide_single(frame, forward ? vertex : feature, forward ? feature : vertex, counters);
  };
  const Vec3 p = of_vertex.vertex(vertex.index);
  if (other.kind == FeatureKind::FACE) {
    if (contacts_.contact_of(frame.flat_moving, on_moving, frame.flat_fixed, on_fixed) != nullptr)
      return true;
    if (!joined) return false;
    single_.clear();
    for_each_face_near(of_other, region_of(of_other, other), std::span(&p, 1), frame.filter.touch,
                       [&](std::int32_t t) { single_.push_back(t); });
    std::sort(single_.begin(), single_.end());
    single_.erase(std::unique(single_.begin(), single_.end()), single_.end());
    for (const std::int32_t t : single_) decide_with({FeatureKind::FACE, t});
    return true;
  }
  Vec3 q;
  double place = 0.0;
  if (other.kind == FeatureKind::VERTEX) {
    q = of_other.vertex(other.index);
  } else {
    const Segment edge = whole_edge(of_other, other);
    place = std::clamp((p - edge[0]).dot(edge[1] - edge[0]) / (edge[1] - edge[0]).squaredNorm(), 0.0, 1.0);
    q = edge[0] + place * (edge[1] - edge[0]);
  }
  if (contacts_.contains(frame.flat_moving, on_moving, frame.flat_fixed, on_fixed, forward ? p : q,
                         forward ? q : p))
    return true;
  if (!joined) return false;
  for_each_edge_at(of_other, straight_of(of_other, other), place, [&](std::int32_t e) {
    decide_with({FeatureKind::EDGE, e});
  });
  return true;
}

/// Decides a pair of single faces, edges and vertices, whatever they are part of.
void Certified::decide_single(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                              WorkCounters& counters) {
  const PairAnswer answer = frame.single_filter(on_moving, on_fixed, 1.0);
  if (answer.verdict != PairVerdict::NO_LMD) settle(frame, on_moving, on_fixed, answer, counters);
}

void Certified::expand_faces(const Frame& frame, std::int32_t region_moving, std::int32_t region_fixed) {
  const double reach = 4.0 * frame.filter.touch;
  corners_.clear();
  frame.flat_fixed.mesh.append_corners(
      frame.filter.fixed, {FeatureKind::FACE, frame.flat_fixed.mesh.lead_of_region(region_fixed)}, corners_);
  find_faces_near(frame.flat_moving, region_moving, frame.flat_fixed, corners_, reach);
  for (const std::int32_t t_moving : near_) {
    const Triangle a = frame.filter.X_WM.triangle(frame.filter.moving.mesh.triangle(t_moving));
    for_each_face_near(frame.flat_fixed, region_fixed, a, reach, [&](std::int32_t t_fixed) {
      pending_.push_back({{t_moving, t_fixed}, false});
    });
  }
}

/// Leaves in near_ the faces of a region near the box of some vertices of the other mesh, ascending.
void Certified::find_faces_near(const FlatSide& side, std::int32_t region, const FlatSide& other,
                                std::span<const std::int32_t> vertices, double reach) {
  points_.clear();
  for (const std::int32_t v : vertices) points_.push_back(other.vertex(v));
  near_.clear();
  for_each_face_near(side, region, points_, reach, [&](std::int32_t t) { near_.push_back(t); });
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
}

void Certified::expand_edge_face(const Frame& frame, const FlatSide& of_edge, std::int32_t straight,
                                 const FlatSide& of_face, std::int32_t region) {
  const Plane plane = of_face.plane(region);
  for (const std::int32_t e : of_edge.mesh.regions->edges_of_straight[straight]) {
    const auto& ends = of_edge.surface.adjacency.edges[static_cast<std::size_t>(e)];
    const std::array<Vec3, 2> points{of_edge.vertex(ends[0]), of_edge.vertex(ends[1])};
    if (has_none_over(of_edge, e, points, plane, frame.filter.touch)) continue;
    for (const std::int32_t t : of_edge.surface.adjacency.edge_triangles[e])
      for_each_face_near(of_face, region, points, 4.0 * frame.filter.touch, [&](std::int32_t face) {
        pending_.push_back({of_edge.is_moving ? TrianglePair{t, face} : TrianglePair{face, t}, false});
      });
  }
}

void Certified::expand_edges(const Frame& frame, std::int32_t straight_moving, std::int32_t straight_fixed) {
  for (const std::int32_t i : frame.flat_moving.mesh.regions->edges_of_straight[straight_moving])
    for (const std::int32_t j : frame.flat_fixed.mesh.regions->edges_of_straight[straight_fixed]) {
      const PairAnswer answer = frame.single_filter({FeatureKind::EDGE, i}, {FeatureKind::EDGE, j}, 1.0);
      if (answer.verdict == PairVerdict::NO_LMD) continue;
      if (have_none_inside(frame.flat_moving, i, frame.flat_fixed, j, frame.filter.touch)) continue;
      for (const std::int32_t t_moving : frame.filter.moving.adjacency.edge_triangles[i])
        for (const std::int32_t t_fixed : frame.filter.fixed.adjacency.edge_triangles[j])
          pending_.push_back({{t_moving, t_fixed}, false});
    }
}

Certificate Certified::decide_touching_flat(const Frame& frame, const WidePair& candidate,
                                            WorkCounters& counters) {
  const FeatureId on_moving = candidate.a.feature_id(), on_fixed = candidate.b.feature_id();
  const std::int32_t region_m = region_of(frame.flat_moving, on_moving);
  const std::int32_t region_f = region_of(frame.flat_fixed, on_fixed);
  const double margin = 2.0 * frame.filter.touch;
  corners_.clear();
  frame.flat_moving.mesh.append_corners(frame.filter.moving, on_moving, corners_);
  fixed_corners_.clear();
  frame.flat_fixed.mesh.append_corners(frame.filter.fixed, on_fixed, fixed_corners_);
  // The end of a gear has hundreds of corners, and each of its teeth is tested against it in every frame: only the feature
  // of fewer corners is held against the other's plane. A triangle without area has no plane and separates nothing.
  const std::size_t count_m = corners_.size(), count_f = fixed_corners_.size();
  if (region_f >= 0 && count_m <= FEW_CORNERS * count_f) {
    const ClearGap gap = gap_to(frame.flat_fixed.plane(region_f), frame.flat_moving, corners_);
    if (gap.gap > margin) return {gap.gap - margin, gap.axis};
  }
  if (region_m >= 0 && count_f <= FEW_CORNERS * count_m) {
    const ClearGap gap = gap_to(frame.flat_moving.plane(region_m), frame.flat_fixed, fixed_corners_);
    if (gap.gap > margin) return {gap.gap - margin, -gap.axis};
  }
  if (region_m >= 0 && region_f >= 0 && count_m * count_f <= MOST_CORNER_PAIRS) {
    points_.clear();
    for (const std::int32_t v : corners_) points_.push_back(frame.flat_moving.vertex(v));
    for (const std::int32_t v : fixed_corners_) points_.push_back(frame.flat_fixed.vertex(v));
    const std::span points(points_);
    const ClearGap gap = gap_along_side_products(frame.flat_moving, region_m, points.first(count_m),
                                                 frame.flat_fixed, region_f, points.subspan(count_m));
    if (gap.gap > margin) return {gap.gap - margin, gap.axis};
  }
  const auto decide_triangles = [&](std::int32_t t_moving, std::int32_t t_fixed) {
    ++counters[Counter::LEAF_PAIRS];
    const Triangle a = frame.filter.X_WM.triangle(frame.filter.moving.mesh.triangle(t_moving));
    const Triangle b = frame.filter.fixed.mesh.triangle(t_fixed);
    const Vec3 normal_a =
        frame.filter.X_WM.direction(frame.filter.moving.face_normals[static_cast<std::size_t>(t_moving)]);
    const Vec3& normal_b = frame.filter.fixed.face_normals[static_cast<std::size_t>(t_fixed)];
    if (clear_gap(a, normal_a, b, normal_b, margin).gap > 0.0) return;
    LocalMinimum minimum;
    if (evaluate(frame, {t_moving, t_fixed}, minimum, counters)) minima_.push_back(minimum);
  };
  // Of the feature of more corners only the triangles near the other one's box, and of those what reaches its plane: a tooth
  // that passes through the plane of a gear's end meets a few of its thousands.
  const bool moving_is_large = count_m > count_f;
  const FlatSide& large = moving_is_large ? frame.flat_moving : frame.flat_fixed;
  const FlatSide& small = moving_is_large ? frame.flat_fixed : frame.flat_moving;
  const std::int32_t region_large = moving_is_large ? region_m : region_f;
  const std::int32_t region_small = moving_is_large ? region_f : region_m;
  const std::int32_t of_large = moving_is_large ? on_moving.index : on_fixed.index;
  const std::int32_t of_small = moving_is_large ? on_fixed.index : on_moving.index;
  if (region_large >= 0)
    find_faces_near(large, region_large, small, moving_is_large ? fixed_corners_ : corners_, margin);
  else
    near_.assign(1, of_large);
  for (const std::int32_t t_large : near_) {
    single_.clear();
    if (region_small < 0) {
      single_.push_back(of_small);
    } else {
      const Triangle t = large.X_WS.triangle(large.surface.mesh.triangle(t_large));
      const Plane plane = small.plane(region_small);
      const double h0 = plane.height(t[0]), h1 = plane.height(t[1]), h2 = plane.height(t[2]);
      if (std::min({h0, h1, h2}) > margin || std::max({h0, h1, h2}) < -margin) continue;
      for_each_face_near(small, region_small, t, margin, [&](std::int32_t near) { single_.push_back(near); });
      std::sort(single_.begin(), single_.end());
      single_.erase(std::unique(single_.begin(), single_.end()), single_.end());
    }
    for (const std::int32_t t_small : single_)
      decide_triangles(moving_is_large ? t_large : t_small, moving_is_large ? t_small : t_large);
  }
  return {};
}

/// Leaves contacts that touch others to their triangles.
/// @param first of minima_ that are this body's
void Certified::settle_touching_contacts(const Frame& frame, std::size_t first, WorkCounters& counters) {
  while (frame.is_flat && contacts_.leave_touching_contacts()) decide_again(frame, first, counters);
}

/// Decides all candidates again, after contacts were left to their triangles.
/// @param first of minima_ that are this body's
void Certified::decide_again(const Frame& frame, std::size_t first, WorkCounters& counters) {
  minima_.resize(first);
  pending_.clear();
  std::vector<WidePair> candidates;
  candidates.swap(flat_candidates_);
  for (const WidePair& candidate : candidates) decide(frame, candidate, 1.0, counters);
}

/// The same for contacts beside minima of their triangles and others'.
/// @param touching of minima_ that are this body's, those of triangles that may touch: they stay
void Certified::settle_contacts_beside(const Frame& frame, std::size_t first,
                                       std::span<const LocalMinimum> touching, WorkCounters& counters) {
  while (contacts_.leave_contacts_beside(frame.flat_moving, frame.flat_fixed,
                                         std::span(minima_).subspan(first))) {
    decide_again(frame, first, counters);
    settle_touching_contacts(frame, first, counters);
    minima_.insert(minima_.end(), touching.begin(), touching.end());
    decide_pending(frame, first, counters);
  }
}

/// Leaves out the minima of this body that are part of its contacts, and adds those.
/// @param first of minima_ that are this body's
void Certified::take_contacts(const Frame& frame, std::size_t first) {
  if (contacts_.contacts().empty()) return;
  minima_.erase(std::remove_if(minima_.begin() + static_cast<std::ptrdiff_t>(first), minima_.end(),
                               [&](const LocalMinimum& minimum) {
                                 const Lmd& lmd = minimum.lmd;
                                 return contacts_.contains(frame.flat_moving, lmd.feature_moving,
                                                           frame.flat_fixed, lmd.feature_fixed,
                                                           lmd.point_moving, lmd.point_fixed);
                               }),
                minima_.end());
  for (const FlatContacts::Contact& contact : contacts_.contacts()) plateaus_.push_back(contact.lmd);
}

}  // namespace lmdbench
