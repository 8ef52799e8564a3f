// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/certified_filter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench {

namespace {

/// Squared sine of the angle below which edges count as parallel: beyond it the feet of the common
/// perpendicular are exact to about 2e-16 / 1e-8 of the edges, well within the margin.
constexpr double PARALLEL_SQUARED_SINE = 1e-8;
/// Half width, as a sine, of the band of directions in which a nearly parallel edge or face pair is
/// borderline.
constexpr double PARALLEL_BAND = 2e-4;

/// Distances that differ from the cutoff by less than this part of it are left to the exact kernel.
constexpr double CUTOFF_MARGIN = 1e-9;

PairVerdict worse(PairVerdict a, PairVerdict b) {
  if (a == PairVerdict::NO_LMD || b == PairVerdict::NO_LMD) return PairVerdict::NO_LMD;
  return a == PairVerdict::LMD && b == PairVerdict::LMD ? PairVerdict::LMD : PairVerdict::BORDERLINE;
}

/// value >= 0 wanted, where `scale` * margin is rounding.
PairVerdict at_least_zero(double value, double scaled_margin) {
  if (value < -scaled_margin) return PairVerdict::NO_LMD;
  return value > scaled_margin ? PairVerdict::LMD : PairVerdict::BORDERLINE;
}

/// One of the two meshes with its pose.
struct Side {
  const Surface& surface;
  const RigidTransform& X;
  bool is_moving;

  const Vec3& vertex_S(std::int32_t vertex) const {
    return surface.mesh.vertices[static_cast<std::size_t>(vertex)];
  }
  Vec3 vertex_W(std::int32_t vertex) const {
    return is_moving ? X.point(vertex_S(vertex)) : vertex_S(vertex);
  }
  Vec3 to_surface(const Vec3& d_W) const { return is_moving ? Vec3(X.rotation.transpose() * d_W) : d_W; }
  Vec3 to_world(const Vec3& d_S) const { return is_moving ? X.direction(d_S) : d_S; }
};

/// Whether d (mesh frame, squared length given) moves away from `corner` as seen from p.
PairVerdict away_from(const Vec3& d_S, double squared_d, const Vec3& to_corner, double margin, double tiny) {
  const double along = d_S.dot(to_corner);
  const double squared_length = to_corner.squaredNorm();
  if (squared_length <= tiny * tiny) return PairVerdict::BORDERLINE;
  if (along * along <= margin * margin * squared_d * squared_length) return PairVerdict::BORDERLINE;
  return along < 0.0 ? PairVerdict::LMD : PairVerdict::NO_LMD;
}

PairVerdict in_vertex_cone(const Side& side, std::int32_t vertex, const Vec3& d_W, double margin,
                           double tiny) {
  const Surface& surface = side.surface;
  const Vec3 d_S = side.to_surface(d_W);
  const double squared_d = d_S.squaredNorm();
  const Vec3& p = side.vertex_S(vertex);
  PairVerdict verdict = PairVerdict::LMD;
  for (const std::int32_t edge : surface.adjacency.vertex_edges[vertex]) {
    const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
    const Vec3 to_corner = side.vertex_S(ends[0] == vertex ? ends[1] : ends[0]) - p;
    verdict = worse(verdict, away_from(d_S, squared_d, to_corner, margin, tiny));
    if (verdict == PairVerdict::NO_LMD) return verdict;
  }
  return verdict;
}

/// @param parameter of the foot on the edge, 0 at its first end
PairVerdict in_edge_cone(const Side& side, std::int32_t edge, double parameter, const Vec3& d_W,
                         double margin, double tiny) {
  const Surface& surface = side.surface;
  const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
  const Vec3 d_S = side.to_surface(d_W);
  const double squared_d = d_S.squaredNorm();
  const Vec3& p0 = side.vertex_S(ends[0]);
  const Vec3 p = p0 + parameter * (side.vertex_S(ends[1]) - p0);
  PairVerdict verdict = PairVerdict::LMD;
  for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge]) {
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
      if (corner == ends[0] || corner == ends[1]) continue;
      verdict = worse(verdict, away_from(d_S, squared_d, side.vertex_S(corner) - p, margin, tiny));
      if (verdict == PairVerdict::NO_LMD) return verdict;
    }
  }
  return verdict;
}

struct Distances {
  double cutoff, touch;

  PairVerdict operator()(double squared_distance) const {
    const double above = cutoff * (1.0 + CUTOFF_MARGIN), below = cutoff * (1.0 - CUTOFF_MARGIN);
    if (squared_distance > above * above || squared_distance < 0.25 * touch * touch)
      return PairVerdict::NO_LMD;
    return squared_distance < below * below ? PairVerdict::LMD : PairVerdict::BORDERLINE;
  }
};

PairVerdict inside_unit(double parameter, double margin) {
  return worse(at_least_zero(parameter, margin), at_least_zero(1.0 - parameter, margin));
}

struct Test {
  const PairFilter& filter;
  Side moving, fixed;
  Distances near;

  explicit Test(const PairFilter& f)
      : filter(f), moving{f.moving, f.X_WM, true}, fixed{f.fixed, f.X_WM, false}, near{f.cutoff, f.touch} {}

  PairVerdict vertex_vertex(std::int32_t a, std::int32_t b) const {
    const Vec3 d = fixed.vertex_W(b) - moving.vertex_W(a);
    PairVerdict verdict = near(d.squaredNorm());
    if (verdict == PairVerdict::NO_LMD) return verdict;
    verdict = worse(verdict, in_vertex_cone(moving, a, d, filter.margin, filter.tiny));
    if (verdict == PairVerdict::NO_LMD) return verdict;
    return worse(verdict, in_vertex_cone(fixed, b, -d, filter.margin, filter.tiny));
  }

  PairVerdict vertex_edge(const Side& of_vertex, std::int32_t vertex, const Side& of_edge,
                          std::int32_t edge) const {
    const auto& ends = of_edge.surface.adjacency.edges[static_cast<std::size_t>(edge)];
    const Vec3 p = of_vertex.vertex_W(vertex);
    const Vec3 e0 = of_edge.vertex_W(ends[0]);
    const Vec3 u = of_edge.vertex_W(ends[1]) - e0;
    const double squared_length = u.squaredNorm();
    if (squared_length <= filter.tiny * filter.tiny)
      return near((e0 - p).squaredNorm()) == PairVerdict::NO_LMD ? PairVerdict::NO_LMD
                                                                 : PairVerdict::BORDERLINE;
    const double parameter = (p - e0).dot(u) / squared_length;
    PairVerdict verdict = inside_unit(parameter, filter.margin);
    if (verdict == PairVerdict::NO_LMD) return verdict;
    const Vec3 d = e0 + parameter * u - p;
    verdict = worse(verdict, near(d.squaredNorm()));
    if (verdict == PairVerdict::NO_LMD) return verdict;
    verdict = worse(verdict, in_vertex_cone(of_vertex, vertex, d, filter.margin, filter.tiny));
    if (verdict == PairVerdict::NO_LMD) return verdict;
    return worse(verdict, in_edge_cone(of_edge, edge, parameter, -d, filter.margin, filter.tiny));
  }

  PairVerdict vertex_face(const Side& of_vertex, std::int32_t vertex, const Side& of_face,
                          std::int32_t face) const {
    const Vec3& normal_S = of_face.surface.face_normals[static_cast<std::size_t>(face)];
    if (normal_S.isZero(0.0)) return PairVerdict::NO_LMD;
    const auto& corners = of_face.surface.mesh.triangles[static_cast<std::size_t>(face)];
    const Vec3 p = of_vertex.vertex_W(vertex);
    const Vec3 n = of_face.to_world(normal_S);
    const std::array<Vec3, 3> x{of_face.vertex_W(corners[0]), of_face.vertex_W(corners[1]),
                                of_face.vertex_W(corners[2])};
    const double height = n.dot(p - x[0]);
    if (height < 0.0) return PairVerdict::NO_LMD;
    PairVerdict verdict = near(height * height);
    if (verdict == PairVerdict::NO_LMD) return verdict;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = x[(k + 1) % 3] - x[k];
      const double squared_side = side.squaredNorm();
      const double squared_rise = (x[(k + 2) % 3] - x[k]).squaredNorm();
      if (squared_side <= filter.tiny * filter.tiny) return PairVerdict::BORDERLINE;
      // Twice the area of side and foot against twice that of the face's parallelogram bound.
      const double inside = side.cross(p - x[k]).dot(n);
      const double scale = std::sqrt(squared_side * squared_rise);
      verdict = worse(verdict, at_least_zero(inside, filter.margin * scale));
      if (verdict == PairVerdict::NO_LMD) return verdict;
    }
    return worse(verdict, in_vertex_cone(of_vertex, vertex, -height * n, filter.margin, filter.tiny));
  }

  PairVerdict edge_edge(std::int32_t a, std::int32_t b) const {
    const auto& ends_a = moving.surface.adjacency.edges[static_cast<std::size_t>(a)];
    const auto& ends_b = fixed.surface.adjacency.edges[static_cast<std::size_t>(b)];
    const Vec3 p0 = moving.vertex_W(ends_a[0]);
    const Vec3 u = moving.vertex_W(ends_a[1]) - p0;
    const Vec3 q0 = fixed.vertex_W(ends_b[0]);
    const Vec3 v = fixed.vertex_W(ends_b[1]) - q0;
    const Vec3 r = p0 - q0;
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ur = u.dot(r), vr = v.dot(r);
    const double determinant = uu * vv - uv * uv;
    const double squared_tiny = filter.tiny * filter.tiny;
    if (uu <= squared_tiny || vv <= squared_tiny || determinant <= PARALLEL_SQUARED_SINE * uu * vv) {
      // Nearly parallel: each must come within reach of the other somewhere.
      const double reach = filter.cutoff + PARALLEL_BAND * (std::sqrt(uu) + std::sqrt(vv));
      const Vec3 across = uu >= vv ? Vec3(r - ur / uu * u) : Vec3(r - vr / vv * v);
      return across.squaredNorm() <= reach * reach ? PairVerdict::BORDERLINE : PairVerdict::NO_LMD;
    }
    const double s = (uv * vr - vv * ur) / determinant;
    PairVerdict verdict = inside_unit(s, filter.margin);
    if (verdict == PairVerdict::NO_LMD) return verdict;
    const double t = (uu * vr - uv * ur) / determinant;
    verdict = worse(verdict, inside_unit(t, filter.margin));
    if (verdict == PairVerdict::NO_LMD) return verdict;
    const Vec3 d = -(r + s * u - t * v);
    verdict = worse(verdict, near(d.squaredNorm()));
    if (verdict == PairVerdict::NO_LMD) return verdict;
    verdict = worse(verdict, in_edge_cone(moving, a, s, d, filter.margin, filter.tiny));
    if (verdict == PairVerdict::NO_LMD) return verdict;
    return worse(verdict, in_edge_cone(fixed, b, t, -d, filter.margin, filter.tiny));
  }

  PairVerdict edge_face(const Side& of_edge, std::int32_t edge, const Side& of_face,
                        std::int32_t face) const {
    const Vec3& normal_S = of_face.surface.face_normals[static_cast<std::size_t>(face)];
    if (normal_S.isZero(0.0)) return PairVerdict::NO_LMD;
    const auto& ends = of_edge.surface.adjacency.edges[static_cast<std::size_t>(edge)];
    const Vec3 e0 = of_edge.vertex_W(ends[0]);
    const Vec3 u = of_edge.vertex_W(ends[1]) - e0;
    const Vec3 n = of_face.to_world(normal_S);
    const double length = u.norm();
    if (length > filter.tiny && std::abs(u.dot(n)) > PARALLEL_BAND * length) return PairVerdict::NO_LMD;
    const auto& corners = of_face.surface.mesh.triangles[static_cast<std::size_t>(face)];
    const double height = n.dot(e0 - of_face.vertex_W(corners[0]));
    const double band = PARALLEL_BAND * length;
    return height < -band || height > filter.cutoff + band ? PairVerdict::NO_LMD : PairVerdict::BORDERLINE;
  }

  PairVerdict face_face(std::int32_t a, std::int32_t b) const {
    const Vec3& normal_a = moving.surface.face_normals[static_cast<std::size_t>(a)];
    const Vec3& normal_b = fixed.surface.face_normals[static_cast<std::size_t>(b)];
    if (normal_a.isZero(0.0) || normal_b.isZero(0.0)) return PairVerdict::NO_LMD;
    const Vec3 sum = moving.to_world(normal_a) + normal_b;
    return sum.squaredNorm() <= PARALLEL_BAND * PARALLEL_BAND ? PairVerdict::BORDERLINE : PairVerdict::NO_LMD;
  }
};

}  // namespace

PairVerdict PairFilter::operator()(const FeatureId& on_moving, const FeatureId& on_fixed) const {
  const Test test(*this);
  const std::int32_t a = on_moving.index, b = on_fixed.index;
  switch (on_moving.kind) {
    case FeatureKind::VERTEX:
      switch (on_fixed.kind) {
        case FeatureKind::VERTEX:
          return test.vertex_vertex(a, b);
        case FeatureKind::EDGE:
          return test.vertex_edge(test.moving, a, test.fixed, b);
        case FeatureKind::FACE:
          return test.vertex_face(test.moving, a, test.fixed, b);
      }
      break;
    case FeatureKind::EDGE:
      switch (on_fixed.kind) {
        case FeatureKind::VERTEX:
          return test.vertex_edge(test.fixed, b, test.moving, a);
        case FeatureKind::EDGE:
          return test.edge_edge(a, b);
        case FeatureKind::FACE:
          return test.edge_face(test.moving, a, test.fixed, b);
      }
      break;
    case FeatureKind::FACE:
      switch (on_fixed.kind) {
        case FeatureKind::VERTEX:
          return test.vertex_face(test.fixed, b, test.moving, a);
        case FeatureKind::EDGE:
          return test.edge_face(test.fixed, b, test.moving, a);
        case FeatureKind::FACE:
          return test.face_face(a, b);
      }
      break;
  }
  return PairVerdict::BORDERLINE;
}

}  // namespace lmdbench
