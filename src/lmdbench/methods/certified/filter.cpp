// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/filter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lmdbench {

namespace {

/// Squared sine of the angle below which edges count as parallel: beyond it the feet of the common
/// perpendicular are exact to about 2e-16 / 1e-8 of the edges, well within the margin.
constexpr double PARALLEL_SQUARED_SINE = 1e-8;
/// Half width, as a sine, of the band of directions in which a nearly parallel edge
/// or face pair is borderline.
constexpr double PARALLEL_BAND = 2e-4;

/// Distances that differ from the cutoff by less than this part of it are left to the exact kernel.
constexpr double CUTOFF_MARGIN = 1e-9;

/// (pi / 3) of the turn of a common perpendicular, rounded up.
constexpr double TURN_FACTOR = 1.05;
/// Turns of two edges, as a share of the sine between them, beyond which nothing is said: with TURN_FACTOR
/// the common perpendicular turns by no more than SPREAD.
constexpr double LARGEST_TURN = 0.05;
constexpr double SPREAD = TURN_FACTOR * LARGEST_TURN;

PairAnswer no_lmd(const Certificate& certificate) {
  return {PairVerdict::NO_LMD, certificate};
}
const PairAnswer ASK{};
const PairAnswer NEVER = no_lmd(Certificate::turned(std::numeric_limits<double>::infinity()));
/// Without a word on what it stands.
const PairAnswer NO_LMD_NOW = no_lmd({});

/// Adds one condition; true when it decides.
bool settle(PairAnswer& answer, const PairAnswer& condition) {
  if (condition.verdict != PairVerdict::NO_LMD) return false;
  answer = condition;
  return true;
}

/// One of the two meshes with its pose.
struct Side {
  const Surface& surface;
  const ShapeComplex& shape;
  const RigidTransform& X_WM;
  bool is_moving;

  const Vec3& vertex_S(std::int32_t vertex) const {
    return surface.mesh.vertices[static_cast<std::size_t>(vertex)];
  }
  Vec3 vertex_W(std::int32_t vertex) const {
    return is_moving ? X_WM.point(vertex_S(vertex)) : vertex_S(vertex);
  }
  Vec3 to_surface(const Vec3& d_W) const { return is_moving ? Vec3(X_WM.rotation.transpose() * d_W) : d_W; }
  Vec3 to_world(const Vec3& d_S) const { return is_moving ? X_WM.direction(d_S) : d_S; }
  std::int32_t chain(std::int32_t edge) const { return shape.chain_of(edge); }
  /// Ends of the chain that an edge is the lead of.
  const std::array<std::int32_t, 2>& ends(std::int32_t edge) const {
    return shape.is_joined ? shape.ends_of_chain(chain(edge))
                           : surface.adjacency.edges[static_cast<std::size_t>(edge)];
  }
  /// Shape of the region that a face is the lead of; null for a face alone.
  const RegionShape* region_shape(std::int32_t face) const {
    if (!shape.is_joined) return nullptr;
    const std::int32_t region = shape.region_of(face);
    return region < 0 ? nullptr : shape.shapes.of_region(region);
  }
  /// Of the region that a face is the lead of; zero without area.
  const Vec3& normal_S(std::int32_t face) const {
    const std::int32_t region = shape.is_joined ? shape.region_of(face) : -1;
    return region >= 0 ? shape.regions.planes[static_cast<std::size_t>(region)].normal
                       : surface.face_normals[static_cast<std::size_t>(face)];
  }
  /// By how much a point of this mesh moves against the other for a displacement of 1.
  double sign() const { return is_moving ? 1.0 : -1.0; }
};

struct Test {
  const PairFilter& filter;
  double lever_arm;
  Side moving, fixed;

  Test(const PairFilter& f, double arm_of_turns)
      : filter(f),
        lever_arm(arm_of_turns),
        moving{f.moving, f.shape_moving, f.X_WM, true},
        fixed{f.fixed, f.shape_fixed, f.X_WM, false} {}

  /// What is left of a length that must fall to zero before anything changes, less what rounding and the
  /// truth's tolerances take. It loses `gradient` times the displacement.
  PairAnswer no_lmd_within(double length, const Vec3& gradient) const {
    return no_lmd({length - 2.0 * filter.touch, gradient, 0.0, lever_arm});
  }

  /// @param d_W between the points, from the moving mesh to the fixed one
  PairAnswer within_cutoff(double squared_distance, const Vec3& d_W) const {
    const double above = filter.reach * (1.0 + CUTOFF_MARGIN);
    if (squared_distance <= above * above) return ASK;
    const double distance = std::sqrt(squared_distance);
    return no_lmd_within(distance - filter.reach, d_W / distance);
  }
  /// The same for two points, whose direction is known only beyond touch.
  PairAnswer near(double squared_distance, const Vec3& d_W) const {
    if (squared_distance < 0.25 * filter.touch * filter.touch) return NO_LMD_NOW;
    return within_cutoff(squared_distance, d_W);
  }

  /// Whether a direction moves away from what a wing leads to.
  /// @param turn_share angle that a unit of sine stands, for a d that only turns; 0 where d changes like
  ///                   a point
  PairAnswer away_from(const Side& side, const Vec3& d_S, double squared_d, const Vec3& wing,
                       double turn_share) const {
    const double along = d_S.dot(wing);
    if (along <= 0.0) return ASK;
    const double squared_length = wing.squaredNorm();
    if (squared_length <= filter.tiny * filter.tiny ||
        along * along <= filter.margin * filter.margin * squared_d * squared_length)
      return ASK;
    const double length = std::sqrt(squared_length), component = along / length;
    if (turn_share > 0.0)
      return no_lmd(Certificate::turned(turn_share * (component / std::sqrt(squared_d) - filter.margin)));
    return no_lmd_within(component, side.sign() / length * side.to_world(wing));
  }

  PairAnswer in_vertex_cone(const Side& side, std::int32_t vertex, const Vec3& d_W, double turn_share) const {
    const Vec3 d_S = side.to_surface(d_W);
    const double squared_d = d_S.squaredNorm();
    PairAnswer answer = ASK;
    side.shape.for_each_corner_wing(side.surface, vertex, [&](const Vec3& wing) {
      return !settle(answer, away_from(side, d_S, squared_d, wing, turn_share));
    });
    return answer;
  }

  PairAnswer in_edge_cone(const Side& side, std::int32_t edge, const Vec3& d_W, double turn_share) const {
    const Vec3 d_S = side.to_surface(d_W);
    const double squared_d = d_S.squaredNorm();
    PairAnswer answer = ASK;
    side.shape.for_each_chain_wing(side.surface, side.chain(edge), [&](const Vec3& wing) {
      return !settle(answer, away_from(side, d_S, squared_d, wing, turn_share));
    });
    return answer;
  }

  PairAnswer vertex_vertex(std::int32_t a, std::int32_t b) const {
    const Vec3 d = fixed.vertex_W(b) - moving.vertex_W(a);
    PairAnswer answer = ASK;
    if (settle(answer, near(d.squaredNorm(), d))) return answer;
    if (settle(answer, in_vertex_cone(moving, a, d, 0.0))) return answer;
    settle(answer, in_vertex_cone(fixed, b, -d, 0.0));
    return answer;
  }

  PairAnswer vertex_edge(const Side& of_vertex, std::int32_t vertex, const Side& of_edge,
                         std::int32_t edge) const {
    const auto& ends = of_edge.ends(edge);
    const Vec3 p = of_vertex.vertex_W(vertex);
    const Vec3 e0 = of_edge.vertex_W(ends[0]);
    const Vec3 u = of_edge.vertex_W(ends[1]) - e0;
    const double squared_length = u.squaredNorm();
    const Vec3 to_end = of_vertex.sign() * (e0 - p);
    if (squared_length <= filter.tiny * filter.tiny)
      return near(to_end.squaredNorm(), to_end).verdict == PairVerdict::NO_LMD ? NO_LMD_NOW : ASK;
    const double parameter = (p - e0).dot(u) / squared_length;
    const double beyond = std::max(-parameter, parameter - 1.0);
    const double length = std::sqrt(squared_length);
    if (beyond > filter.margin && beyond * length > 2.0 * filter.rounding) {
      const double inwards = parameter < 0.0 ? of_vertex.sign() : -of_vertex.sign();
      return no_lmd_within(beyond * length, inwards / length * u);
    }
    PairAnswer answer = ASK;
    const Vec3 d = e0 + parameter * u - p;
    if (settle(answer, near(d.squaredNorm(), of_vertex.sign() * d))) return answer;
    if (!settle(answer, in_vertex_cone(of_vertex, vertex, d, 0.0)))
      settle(answer, in_edge_cone(of_edge, edge, -d, 0.0));
    // d stays square to the edge.
    answer.certificate.gradient -= answer.certificate.gradient.dot(u) / squared_length * u;
    return answer;
  }

  PairAnswer vertex_face(const Side& of_vertex, std::int32_t vertex, const Side& of_face,
                         std::int32_t face) const {
    const Vec3& normal_S = of_face.normal_S(face);
    if (normal_S.isZero(0.0)) return NEVER;
    if (const RegionShape* shape = of_face.region_shape(face))
      return vertex_region(of_vertex, vertex, of_face, face, *shape);
    const auto& corners = of_face.surface.mesh.triangles[static_cast<std::size_t>(face)];
    const Vec3 p = of_vertex.vertex_W(vertex);
    const Vec3 n = of_face.to_world(normal_S);
    const std::array<Vec3, 3> x{of_face.vertex_W(corners[0]), of_face.vertex_W(corners[1]),
                                of_face.vertex_W(corners[2])};
    const double height = n.dot(p - x[0]);
    const Vec3 rise = of_vertex.sign() * n;  // of the height, for a displacement
    if (height < -filter.touch) return no_lmd_within(-height, rise);
    PairAnswer answer = ASK;
    if (settle(answer, within_cutoff(height * height, -height * rise))) return answer;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = x[(k + 1) % 3] - x[k];
      const double squared_side = side.squaredNorm();
      const double squared_rise = (x[(k + 2) % 3] - x[k]).squaredNorm();
      if (squared_side <= filter.tiny * filter.tiny) return ASK;
      // Distance from the side times its length, against that of a right angle.
      const double distance = side.cross(p - x[k]).dot(n);
      const double width =
          std::max(filter.margin * filter.margin * squared_rise, 4.0 * filter.rounding * filter.rounding);
      const double allowed = std::sqrt(squared_side * width);
      if (distance < -allowed) {
        const double length = std::sqrt(squared_side);
        return no_lmd_within(-distance / length, rise.cross(side) / length);
      }
    }
    settle(answer, in_vertex_cone(of_vertex, vertex, -n, 1.0));
    return answer;
  }

  /// The outline's bounding box alone; the definition says whether the foot is inside.
  PairAnswer vertex_region(const Side& of_vertex, std::int32_t vertex, const Side& of_face, std::int32_t face,
                           const RegionShape& shape) const {
    const Plane& plane =
        of_face.shape.regions.planes[static_cast<std::size_t>(of_face.shape.region_of(face))];
    const Vec3 p = of_vertex.vertex_W(vertex);
    const Vec3 p_S =
        of_face.is_moving ? Vec3(of_face.X_WM.rotation.transpose() * (p - of_face.X_WM.translation)) : p;
    const Vec3 n = of_face.to_world(plane.normal);
    const double height = plane.height(p_S);
    const Vec3 rise = of_vertex.sign() * n;
    if (height < -filter.touch) return no_lmd_within(-height, rise);
    PairAnswer answer = ASK;
    if (settle(answer, within_cutoff(height * height, -height * rise))) return answer;
    const Vec2 low = shape.triangle_grid.low(), high = shape.triangle_grid.high();
    const Vec2 x = shape.frame.flat(p_S);
    for (int k = 0; k < 2; ++k) {
      const Vec3 axis = of_vertex.sign() * of_face.to_world(k == 0 ? shape.frame.u : shape.frame.v);
      if (x[k] > high[k] + 2.0 * filter.touch) return no_lmd_within(x[k] - high[k], -axis);
      if (x[k] < low[k] - 2.0 * filter.touch) return no_lmd_within(low[k] - x[k], axis);
    }
    settle(answer, in_vertex_cone(of_vertex, vertex, -n, 1.0));
    return answer;
  }

  PairAnswer edge_edge(std::int32_t a, std::int32_t b) const {
    const auto& ends_a = moving.ends(a);
    const auto& ends_b = fixed.ends(b);
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
      const double reach = filter.reach + PARALLEL_BAND * (std::sqrt(uu) + std::sqrt(vv));
      const Vec3 across = uu >= vv ? Vec3(r - ur / uu * u) : Vec3(r - vr / vv * v);
      return across.squaredNorm() <= reach * reach ? ASK : NO_LMD_NOW;
    }
    const double s = (uv * vr - vv * ur) / determinant;
    const double t = (uu * vr - uv * ur) / determinant;
    // The end beyond the other edge's plane through the common perpendicular, and how fast that plane can turn.
    const double sine = std::sqrt(determinant / (uu * vv));
    const double length_u = std::sqrt(uu), length_v = std::sqrt(vv);
    const double beyond_s = std::max(-s, s - 1.0) * length_u, beyond_t = std::max(-t, t - 1.0) * length_v;
    const double spare = 2.0 * filter.rounding / sine;
    if (beyond_s > std::max(filter.margin * length_u, spare) ||
        beyond_t > std::max(filter.margin * length_v, spare)) {
      const Vec3 d = r + s * u - t * v;
      // Inwards: along the edge that is left behind, square to the other.
      const Vec3 gradient = beyond_s > beyond_t
                                ? Vec3((s < 0.0 ? -1.0 : 1.0) / (length_u * sine) * (u - uv / vv * v))
                                : Vec3((t < 0.0 ? 1.0 : -1.0) / (length_v * sine) * (v - uv / uu * u));
      const double beyond = std::max(beyond_s, beyond_t);
      // Every point of the edge must stay on its side, so the farthest one is the lever arm.
      const double arm = beyond + d.norm() + std::max(length_u, length_v);
      return no_lmd({beyond * sine - 2.0 * filter.touch, gradient, SPREAD,
                     (1.0 + SPREAD) * lever_arm + TURN_FACTOR * arm / sine, LARGEST_TURN * sine});
    }
    PairAnswer answer = ASK;
    const Vec3 d = -(r + s * u - t * v);
    const double squared_d = d.squaredNorm();
    // Next to touch the direction is known from the edges alone.
    if (squared_d < filter.touch * filter.touch || settle(answer, within_cutoff(squared_d, d))) return answer;
    if (settle(answer, in_edge_cone(moving, a, d, sine / TURN_FACTOR)) ||
        settle(answer, in_edge_cone(fixed, b, -d, sine / TURN_FACTOR))) {
      // d turns smoothly as long as the edges do not pass through each other.
      const double distance = std::sqrt(squared_d);
      answer.certificate = {(1.0 - SPREAD) * distance - 2.0 * filter.touch, d / distance, SPREAD,
                            (1.0 + SPREAD) * lever_arm,
                            std::min(answer.certificate.turn, LARGEST_TURN * sine)};
    }
    return answer;
  }

  PairAnswer edge_face(const Side& of_edge, std::int32_t edge, const Side& of_face, std::int32_t face) const {
    const Vec3& normal_S = of_face.normal_S(face);
    if (normal_S.isZero(0.0)) return NEVER;
    const auto& ends = of_edge.ends(edge);
    const Vec3 e0 = of_edge.vertex_W(ends[0]);
    const Vec3 u = of_edge.vertex_W(ends[1]) - e0;
    const Vec3 n = of_face.to_world(normal_S);
    const double length = u.norm();
    const double band = PARALLEL_BAND * length;
    const double rise = std::abs(u.dot(n));
    if (length > filter.tiny && rise > band)
      return no_lmd(Certificate::turned(rise / length - 0.5 * PARALLEL_BAND));
    const auto& corners = of_face.surface.mesh.triangles[static_cast<std::size_t>(face)];
    const double height = n.dot(e0 - of_face.vertex_W(corners[0]));
    const Vec3 outwards = of_edge.sign() * n;
    if (height < -band) return no_lmd_within(-height, outwards);
    return height > filter.reach + band ? no_lmd_within(height - filter.reach, -outwards) : ASK;
  }

  PairAnswer face_face(std::int32_t a, std::int32_t b) const {
    const Vec3& normal_a = moving.normal_S(a);
    const Vec3& normal_b = fixed.normal_S(b);
    if (normal_a.isZero(0.0) || normal_b.isZero(0.0)) return NEVER;
    const double apart = (moving.to_world(normal_a) + normal_b).norm();
    return apart > PARALLEL_BAND ? no_lmd(Certificate::turned(apart - 0.5 * PARALLEL_BAND)) : ASK;
  }
};

}  // namespace

PairAnswer PairFilter::operator()(const FeatureId& on_moving, const FeatureId& on_fixed,
                                  double lever_arm) const {
  const Test test(*this, lever_arm);
  const std::int32_t a = on_moving.index, b = on_fixed.index;
  using enum FeatureKind;
  switch (on_moving.kind) {
    case VERTEX:
      if (on_fixed.kind == VERTEX) return test.vertex_vertex(a, b);
      if (on_fixed.kind == EDGE) return test.vertex_edge(test.moving, a, test.fixed, b);
      return test.vertex_face(test.moving, a, test.fixed, b);
    case EDGE:
      if (on_fixed.kind == VERTEX) return test.vertex_edge(test.fixed, b, test.moving, a);
      if (on_fixed.kind == EDGE) return test.edge_edge(a, b);
      return test.edge_face(test.moving, a, test.fixed, b);
    case FACE:
      if (on_fixed.kind == VERTEX) return test.vertex_face(test.fixed, b, test.moving, a);
      if (on_fixed.kind == EDGE) return test.edge_face(test.fixed, b, test.moving, a);
      return test.face_face(a, b);
  }
  return {};
}

}  // namespace lmdbench
