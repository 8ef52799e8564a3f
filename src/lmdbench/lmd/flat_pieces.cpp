// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/flat_pieces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

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

ParallelRule ParallelRule::of(const Surface& moving, const FlatRegions& moving_regions, const Surface& fixed,
                              const FlatRegions& fixed_regions) {
  const auto flat_to = [](const Surface& surface, const FlatRegions& regions) {
    return std::max(surface.mesh.planar_tolerance, FLATNESS * regions.extent);
  };
  const bool is_exact = parallel_tolerance(moving, fixed) == 0.0;
  return {flat_to(moving, moving_regions) + flat_to(fixed, fixed_regions),
          is_exact ? LARGEST_EXACT_TILT : LARGEST_PARALLEL_TILT,
          coincidence_length(moving_regions.extent + fixed_regions.extent),
          FLATNESS * (moving_regions.extent + fixed_regions.extent), is_exact};
}

bool ParallelRule::drifts_sideways(const Vec3& u, const Vec3& v) const {
  const double length_u = u.norm(), length_v = v.norm(), crossed = u.cross(v).norm();
  return is_exact && crossed > PARALLEL_TILT * length_u * length_v &&
         crossed / std::max(length_u, length_v) > allowance;
}

bool ParallelRule::is_speck(const ConvexPolygon& polygon, double area) const {
  double longest = 0.0;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k)
    longest =
        std::max(longest, (polygon.corners[(k + 1) % polygon.corners.size()] - polygon.corners[k]).norm());
  return !(area > least_width * longest);
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
  /// From end to end of a straight edge, in the world.
  Vec3 whole(std::int32_t straight_edge) const {
    const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight_edge)].ends;
    return X_WS.direction(surface.mesh.vertices[static_cast<std::size_t>(ends[1])] -
                          surface.mesh.vertices[static_cast<std::size_t>(ends[0])]);
  }
  /// Straight edge of a side that this triangle is the first on, or -1.
  std::int32_t straight(std::size_t side) const {
    if (surface.adjacency.edge_triangles[edge(side)].front() != triangle) return -1;
    return regions.straight_of_edge[static_cast<std::size_t>(edge(side))];
  }
};

FlatPieces::FlatPieces(const Scene& scene) : scene_(scene) {
  moving_ = &scene.moving->prepared<FlatRegions>();
  for (const auto& body : scene.fixed) {
    fixed_.push_back(&body->prepared<FlatRegions>());
    rules_.push_back(ParallelRule::of(scene.moving->surface(), *moving_, body->surface(), *fixed_.back()));
  }
}

void FlatPieces::offer(const RigidTransform& X_WM, std::int32_t body, std::int32_t t_moving,
                       std::int32_t t_fixed) {
  static const RigidTransform identity;
  const auto b = static_cast<std::size_t>(body);
  X_WM_ = X_WM;
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
  const ParallelRule& rule = rules_[static_cast<std::size_t>(body)];
  const double tilt = (plane_m.normal + plane_f.normal).norm();
  if (tilt > rule.largest_tilt) return;
  const Vec3 n = contact_direction(plane_m.normal, plane_f.normal, moving.surface, fixed.surface);
  const PlanarFrame frame(fixed.corners[0], n);
  const ConvexPolygon a(frame, moving.corners), b(frame, fixed.corners);
  const ConvexPolygon overlap = a.cut_by(b);
  const AreaAndCentroid whole = overlap.measure();
  if (rule.is_speck(overlap, whole.area)) return;
  Piece piece{{body, 2, {FeatureKind::FACE, moving.region()}, {FeatureKind::FACE, fixed.region()}},
              tilt,
              std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity(),
              {},
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
  const ParallelRule& rule = rules_[static_cast<std::size_t>(body)];
  if (!(length > 0.0) || std::abs(u.dot(plane.normal)) > rule.largest_tilt * length) return;
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
  // Of the whole line: that of one edge says less.
  const Vec3 whole = of_edge.whole(straight.index);
  Piece piece{{body, 1, forward ? straight : region, forward ? region : straight},
              std::abs(whole.dot(plane.normal)) / whole.norm(),
              std::min(d0, d1),
              std::max(d0, d1),
              {},
              {part.begin, part.end, x0, u, n, plane}};
  Lmd& lmd = piece.minimum.lmd;
  lmd.feature_moving = forward ? edge : face;
  lmd.feature_fixed = forward ? face : edge;
  (forward ? lmd.point_moving : lmd.point_fixed) = middle;
  (forward ? lmd.point_fixed : lmd.point_moving) = middle + d * n;
  add(forward ? of_edge : of_face, forward ? of_face : of_edge, body, piece);
}

void FlatPieces::offer_edges(const Side& moving, std::size_t side_moving, const Side& fixed,
                             std::size_t side_fixed, std::int32_t body) {
  const Vec3& a0 = moving.corners[side_moving];
  const Vec3 u = moving.corners[(side_moving + 1) % 3] - a0;
  const Vec3& b0 = fixed.corners[side_fixed];
  const Vec3 v = fixed.corners[(side_fixed + 1) % 3] - b0;
  const double length_u = u.norm(), length_v = v.norm();
  const ParallelRule& rule = rules_[static_cast<std::size_t>(body)];
  const Vec3 whole_u = moving.whole(moving.straight(side_moving));
  const Vec3 whole_v = fixed.whole(fixed.straight(side_fixed));
  if (!(length_u > 0.0 && length_v > 0.0) || u.cross(v).norm() > rule.largest_tilt * length_u * length_v ||
      rule.drifts_sideways(whole_u, whole_v))
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
              whole_u.cross(whole_v).norm() / (whole_u.norm() * whole_v.norm()),
              std::min({d0, d1, d.norm()}),
              std::max({d0, d1, d.norm()}),
              {},
              {}};
  piece.minimum.measure = end - begin;
  piece.minimum.lmd.point_moving = p;
  piece.minimum.lmd.point_fixed = p + d;
  piece.minimum.lmd.feature_moving = edge_m;
  piece.minimum.lmd.feature_fixed = edge_f;
  add(moving, fixed, body, piece);
}

FlatPieces::Place FlatPieces::place_of(const LocalMinimum& minimum) const {
  const Lmd& lmd = minimum.lmd;
  const auto b = static_cast<std::size_t>(lmd.fixed_body);
  return {lmd.fixed_body, minimum.dimension,
          moving_->flat_feature_of(scene_.moving->surface(), lmd.feature_moving),
          fixed_[b]->flat_feature_of(scene_.fixed[b]->surface(), lmd.feature_fixed)};
}

/// Whether a point of the region's plane lies on its border: an edge along it is over the border's edge, not the region.
bool FlatPieces::is_along_border(const Place& place, const OverFace& over, const Vec3& x) const {
  static const RigidTransform identity;
  const auto b = static_cast<std::size_t>(place.body);
  const bool over_moving = place.moving.kind == FeatureKind::FACE;
  const TriangleMesh& mesh = (over_moving ? *scene_.moving : *scene_.fixed[b]).surface().mesh;
  const RigidTransform& X_WS = over_moving ? X_WM_ : identity;
  const Vec3 foot = x + along(over.plane, over.n, x) * over.n;
  const std::int32_t region = (over_moving ? place.moving : place.fixed).index;
  const FlatRegions& regions = over_moving ? *moving_ : *fixed_[b];
  const auto border = regions.straight_edges_of_region[region];
  return std::any_of(border.begin(), border.end(), [&](std::int32_t straight) {
    const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight)].ends;
    const auto end = [&](std::size_t k) {
      return X_WS.point(mesh.vertices[static_cast<std::size_t>(ends[k])]);
    };
    return (point_segment_distance(foot, {end(0), end(1)}).point - foot).norm() <= rules_[b].least_width;
  });
}

/// Appends what the pieces of an edge over a region cover, each part once.
void FlatPieces::append_over_face(std::span<Piece> pieces, std::vector<LocalMinimum>& minima) const {
  const auto edge_of = [](const Piece& piece) {
    const Lmd& lmd = piece.minimum.lmd;
    return lmd.feature_moving.kind == FeatureKind::EDGE ? lmd.feature_moving.index : lmd.feature_fixed.index;
  };
  std::stable_sort(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
    return std::tuple(edge_of(a), a.over.begin) < std::tuple(edge_of(b), b.over.begin);
  });
  std::int32_t edge = -1;
  double reached = 0.0;
  for (const Piece& piece : pieces) {
    if (edge_of(piece) != edge) reached = 0.0;
    edge = edge_of(piece);
    const OverFace& over = piece.over;
    const double begin = std::max(over.begin, reached), end = over.end;
    if (!(end > begin)) continue;
    reached = end;
    const Vec3 middle = over.x0 + 0.5 * (begin + end) * over.u;
    if (is_along_border(piece.place, over, middle)) continue;
    LocalMinimum& minimum = minima.emplace_back(piece.minimum);
    Lmd& lmd = minimum.lmd;
    minimum.measure = (end - begin) * over.u.norm();
    lmd.distance = along(over.plane, over.n, middle);
    const Vec3 foot = middle + lmd.distance * over.n;
    const bool of_moving = lmd.feature_moving.kind == FeatureKind::EDGE;
    lmd.point_moving = of_moving ? middle : foot;
    lmd.point_fixed = of_moving ? foot : middle;
  }
}

void FlatPieces::append_parallel(std::vector<LocalMinimum>& minima, std::size_t first) {
  if (pieces_.empty()) return;
  std::stable_sort(pieces_.begin(), pieces_.end(),
                   [](const Piece& a, const Piece& b) { return a.place < b.place; });
  std::vector<std::span<Piece>> over_faces;
  const std::size_t before = minima.size();
  for (std::size_t begin = 0; begin < pieces_.size();) {
    std::size_t end = begin;
    const Place& place = pieces_[begin].place;
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (; end < pieces_.size() && pieces_[end].place == place; ++end) {
      least = std::min(least, pieces_[end].least_distance);
      greatest = std::max(greatest, pieces_[end].greatest_distance);
    }
    const ParallelRule& rule = rules_[static_cast<std::size_t>(place.body)];
    // Features that cross have no direction: their triangles say so.
    if (least > rule.least_gap && rule.is_parallel(pieces_[begin].tilt, greatest - least)) {
      if (place.moving.kind != place.fixed.kind)
        over_faces.push_back(std::span(pieces_).subspan(begin, end - begin));
      else
        for (std::size_t i = begin; i < end; ++i) minima.push_back(pieces_[i].minimum);
    }
    begin = end;
  }
  if (over_faces.empty()) return;
  const auto has_place = [&](const LocalMinimum& minimum) {
    if (minimum.dimension != 1 || minimum.lmd.intersecting) return false;
    const Place place = place_of(minimum);
    const auto found =
        std::lower_bound(over_faces.begin(), over_faces.end(), place,
                         [](const std::span<Piece>& a, const Place& b) { return a.front().place < b; });
    return found != over_faces.end() && found->front().place == place;
  };
  const auto from = minima.begin() + static_cast<std::ptrdiff_t>(first);
  minima.erase(std::remove_if(from, minima.begin() + static_cast<std::ptrdiff_t>(before), has_place),
               minima.begin() + static_cast<std::ptrdiff_t>(before));
  for (const std::span<Piece>& pieces : over_faces) append_over_face(pieces, minima);
}

}  // namespace lmdbench
