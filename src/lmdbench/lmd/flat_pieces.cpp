// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/flat_pieces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench {

namespace {

/// Place of a plane along the direction n over the point x.
double along(const Plane& plane, const Vec3& n, const Vec3& x) {
  return plane.normal.dot(plane.point - x) / plane.normal.dot(n);
}

Plane placed(const Plane& plane, const RigidTransform& X) {
  return {X.point(plane.point), X.direction(plane.normal)};
}

}  // namespace

double parallel_tolerance(const Surface& moving, const Surface& fixed) {
  return moving.mesh.planar_tolerance + fixed.mesh.planar_tolerance;
}

Vec3 contact_direction(const Vec3& normal_moving, const Vec3& normal_fixed, const Surface& moving,
                       const Surface& fixed) {
  const bool moving_is_rounded = moving.mesh.planar_tolerance > 0.0;
  if (moving_is_rounded == (fixed.mesh.planar_tolerance > 0.0))
    return (normal_moving - normal_fixed).normalized();
  return moving_is_rounded ? Vec3(-normal_fixed) : normal_moving;
}

/// A triangle of one of the meshes in the world.
struct FlatPieces::Side {
  const Surface& surface;
  const FlatRegions& regions;
  const RigidTransform& X_WS;
  std::int32_t triangle;
  Triangle corners;
  bool is_moving;

  Side(const Surface& of, const FlatRegions& flat, const RigidTransform& X, std::int32_t t, bool moving)
      : surface(of),
        regions(flat),
        X_WS(X),
        triangle(t),
        corners(X.triangle(of.mesh.triangle(t))),
        is_moving(moving) {}

  std::int32_t region() const { return regions.region_of_triangle[static_cast<std::size_t>(triangle)]; }
  Plane plane() const { return placed(regions.planes[static_cast<std::size_t>(region())], X_WS); }
  std::int32_t edge(std::size_t side) const {
    return surface.adjacency.triangle_edges[static_cast<std::size_t>(triangle)][side];
  }
  /// Straight edge of a side that this triangle is the first on, or -1.
  std::int32_t straight(std::size_t side) const {
    if (surface.adjacency.edge_triangles[edge(side)].front() != triangle) return -1;
    return regions.straight_of_edge[static_cast<std::size_t>(edge(side))];
  }
};

FlatPieces::FlatPieces(const Scene& scene) : scene_(scene) {
  moving_ = &scene.moving->prepared<FlatRegions>();
  for (const auto& body : scene.fixed) fixed_.push_back(&body->prepared<FlatRegions>());
}

void FlatPieces::offer(const RigidTransform& X_WM, std::int32_t body, std::int32_t t_moving,
                       std::int32_t t_fixed) {
  static const RigidTransform identity;
  const auto b = static_cast<std::size_t>(body);
  if (!(parallel_tolerance(scene_.moving->surface(), scene_.fixed[b]->surface()) > 0.0)) return;
  const Side moving(scene_.moving->surface(), *moving_, X_WM, t_moving, true);
  const Side fixed(scene_.fixed[b]->surface(), *fixed_[b], identity, t_fixed, false);
  if (moving.region() < 0 || fixed.region() < 0) return;
  offer_faces(moving, fixed, body);
  for (std::size_t i = 0; i < 3; ++i) {
    if (moving.straight(i) >= 0) offer_edge_face(moving, i, fixed, body);
    if (fixed.straight(i) >= 0) offer_edge_face(fixed, i, moving, body);
    for (std::size_t j = 0; j < 3; ++j)
      if (moving.straight(i) >= 0 && fixed.straight(j) >= 0) offer_edges(moving, i, fixed, j, body);
  }
}

void FlatPieces::add(const Side& moving, const Side& fixed, std::int32_t body, const Piece& piece) {
  Piece& added = pieces_.emplace_back(piece);
  Lmd& lmd = added.minimum.lmd;
  const Vec3 d = lmd.point_fixed - lmd.point_moving;
  lmd.distance = d.norm();
  lmd.direction = d / lmd.distance;
  lmd.triangle_moving = moving.triangle;
  lmd.triangle_fixed = fixed.triangle;
  lmd.fixed_body = body;
  added.minimum.dimension = piece.place.dimension;
  added.place.body = body;
}

void FlatPieces::offer_faces(const Side& moving, const Side& fixed, std::int32_t body) {
  const Plane plane_m = moving.plane(), plane_f = fixed.plane();
  if ((plane_m.normal + plane_f.normal).norm() > LARGEST_PARALLEL_TILT) return;
  const Vec3 n = contact_direction(plane_m.normal, plane_f.normal, moving.surface, fixed.surface);
  const PlanarFrame frame(fixed.corners[0], n);
  const ConvexPolygon a(frame, moving.corners), b(frame, fixed.corners);
  const ConvexPolygon overlap = a.cut_by(b);
  const AreaAndCentroid whole = overlap.measure();
  if (!(whole.area > 0.0)) return;
  Piece piece{{body, 2, {FeatureKind::FACE, moving.region()}, {FeatureKind::FACE, fixed.region()}},
              std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity(),
              {}};
  for (const Vec2& corner : overlap.corners) {
    const Vec3 x = frame.lifted(corner);
    const double distance = along(plane_f, n, x) - along(plane_m, n, x);
    piece.least_distance = std::min(piece.least_distance, distance);
    piece.greatest_distance = std::max(piece.greatest_distance, distance);
  }
  const Vec3 x = frame.lifted(whole.centroid);
  piece.minimum.measure = whole.area;
  piece.minimum.lmd.point_moving = x + along(plane_m, n, x) * n;
  piece.minimum.lmd.point_fixed = x + along(plane_f, n, x) * n;
  piece.minimum.lmd.feature_moving = {FeatureKind::FACE, moving.triangle};
  piece.minimum.lmd.feature_fixed = {FeatureKind::FACE, fixed.triangle};
  add(moving, fixed, body, piece);
}

void FlatPieces::offer_edge_face(const Side& of_edge, std::size_t side, const Side& of_face,
                                 std::int32_t body) {
  const Vec3& x0 = of_edge.corners[side];
  const Vec3& x1 = of_edge.corners[(side + 1) % 3];
  const Vec3 u = x1 - x0;
  const double length = u.norm();
  const Plane plane = of_face.plane();
  if (!(length > 0.0) || std::abs(u.dot(plane.normal)) > LARGEST_PARALLEL_TILT * length) return;
  // From the edge to the face, square to the edge.
  const Vec3 n = -(plane.normal - u.dot(plane.normal) / (length * length) * u).normalized();
  const PlanarFrame frame(of_face.corners[0], n);
  const SegmentPart part = ConvexPolygon(frame, of_face.corners).part_of(frame.flat(x0), frame.flat(x1));
  if (!(part.end > part.begin)) return;
  const Vec3 p0 = x0 + part.begin * u, p1 = x0 + part.end * u, middle = 0.5 * (p0 + p1);
  const double d0 = along(plane, n, p0), d1 = along(plane, n, p1), d = along(plane, n, middle);
  const FeatureId edge{FeatureKind::EDGE, of_edge.edge(side)};
  if (!(d > 0.0) || !in_outward_polar_cone(of_edge.surface, of_edge.X_WS, edge, middle, d * n)) return;
  const FeatureId face{FeatureKind::FACE, of_face.triangle};
  const FeatureId straight{FeatureKind::EDGE, of_edge.straight(side)};
  const FeatureId region{FeatureKind::FACE, of_face.region()};
  const bool forward = of_edge.is_moving;
  Piece piece{{body, 1, forward ? straight : region, forward ? region : straight},
              std::min(d0, d1),
              std::max(d0, d1),
              {}};
  piece.minimum.measure = (part.end - part.begin) * length;
  Lmd& lmd = piece.minimum.lmd;
  (forward ? lmd.point_moving : lmd.point_fixed) = middle;
  (forward ? lmd.point_fixed : lmd.point_moving) = middle + d * n;
  lmd.feature_moving = forward ? edge : face;
  lmd.feature_fixed = forward ? face : edge;
  add(forward ? of_edge : of_face, forward ? of_face : of_edge, body, piece);
}

void FlatPieces::offer_edges(const Side& moving, std::size_t side_moving, const Side& fixed,
                             std::size_t side_fixed, std::int32_t body) {
  const Vec3& a0 = moving.corners[side_moving];
  const Vec3 u = moving.corners[(side_moving + 1) % 3] - a0;
  const Vec3& b0 = fixed.corners[side_fixed];
  const Vec3 v = fixed.corners[(side_fixed + 1) % 3] - b0;
  const double length_u = u.norm(), length_v = v.norm();
  if (!(length_u > 0.0 && length_v > 0.0) || u.cross(v).norm() > LARGEST_PARALLEL_TILT * length_u * length_v)
    return;
  const double sense = u.dot(v) > 0.0 ? 1.0 : -1.0;
  const Vec3 w = (u / length_u + sense / length_v * v).normalized();
  // Places along w, from a0.
  const double end_a = u.dot(w), begin_b = (b0 - a0).dot(w), end_b = begin_b + v.dot(w);
  const double begin = std::max(0.0, std::min(begin_b, end_b)),
               end = std::min(end_a, std::max(begin_b, end_b));
  if (!(end > begin)) return;
  const auto on_moving = [&](double s) { return Vec3(a0 + s / end_a * u); };
  const auto on_fixed = [&](double s) { return Vec3(b0 + (s - begin_b) / (end_b - begin_b) * v); };
  const double middle = 0.5 * (begin + end);
  const Vec3 p = on_moving(middle), d = on_fixed(middle) - p;
  const FeatureId edge_m{FeatureKind::EDGE, moving.edge(side_moving)};
  const FeatureId edge_f{FeatureKind::EDGE, fixed.edge(side_fixed)};
  // Along the edges d is only rounding; their ends must not decide.
  const Vec3 across_m = d - d.dot(u) / (length_u * length_u) * u;
  const Vec3 across_f = d - d.dot(v) / (length_v * length_v) * v;
  if (!(d.squaredNorm() > 0.0) || !in_outward_polar_cone(moving.surface, moving.X_WS, edge_m, p, across_m) ||
      !in_outward_polar_cone(fixed.surface, fixed.X_WS, edge_f, p + d, -across_f))
    return;
  const double d0 = (on_fixed(begin) - on_moving(begin)).norm();
  const double d1 = (on_fixed(end) - on_moving(end)).norm();
  Piece piece{{body,
               1,
               {FeatureKind::EDGE, moving.straight(side_moving)},
               {FeatureKind::EDGE, fixed.straight(side_fixed)}},
              std::min({d0, d1, d.norm()}),
              std::max({d0, d1, d.norm()}),
              {}};
  piece.minimum.measure = end - begin;
  piece.minimum.lmd.point_moving = p;
  piece.minimum.lmd.point_fixed = p + d;
  piece.minimum.lmd.feature_moving = edge_m;
  piece.minimum.lmd.feature_fixed = edge_f;
  add(moving, fixed, body, piece);
}

void FlatPieces::append_parallel(std::vector<LocalMinimum>& minima) {
  std::stable_sort(pieces_.begin(), pieces_.end(),
                   [](const Piece& a, const Piece& b) { return a.place < b.place; });
  for (std::size_t begin = 0; begin < pieces_.size();) {
    std::size_t end = begin;
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (; end < pieces_.size() && pieces_[end].place == pieces_[begin].place; ++end) {
      least = std::min(least, pieces_[end].least_distance);
      greatest = std::max(greatest, pieces_[end].greatest_distance);
    }
    const auto& fixed = scene_.fixed[static_cast<std::size_t>(pieces_[begin].place.body)]->surface();
    // Faces that cross have no distance: their triangles say so.
    if (least > 0.0 && greatest - least <= parallel_tolerance(scene_.moving->surface(), fixed))
      for (std::size_t i = begin; i < end; ++i) minima.push_back(pieces_[i].minimum);
    begin = end;
  }
}

}  // namespace lmdbench
