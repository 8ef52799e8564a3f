// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/polar_cone.h>
#include <lmdbench/mesh/vertex_neighbours.h>
#include <lmdbench/snch/polar_cap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

/// n . direction <= slack for unit n.
struct Constraint {
  Vec3 direction;
  double slack;
};

/// Crossings of planes that are closer to parallel than this (a sine) are left out: their neighbours bound
/// the cone to within the slack.
constexpr double LEAST_CROSSING = 1e-6;
/// Planes whose angle has a larger sine than this cross clearly: most candidates can be rejected without a
/// root.
constexpr double CLEAR_CROSSING = 0.2;
/// A constraint that is looser than this (a sine) is dropped; caps of needle-like triangles get wider, never
/// wrong.
constexpr double LARGEST_SLACK = 0.1;
/// Heights of triangles below this part of their length are rounding: such a triangle constrains nothing.
constexpr double LEAST_HEIGHT = 1e-12;

/// How far a direction may stick out of a cone, as a difference of cosines, before the cone grows: far below
/// the slack that is added, far above rounding.
constexpr double RIM_TOLERANCE = 1e-13;
/// An axis that comes out shorter than this is rounding.
constexpr double LEAST_AXIS = 1e-9;

/// Extreme directions of a polar cone, and what must be added to their spread.
struct Extremes {
  std::vector<Vec3> directions;
  double slack = 0.0;
};

/// Axis of the smallest circular cone around directions that a half space holds; not unit. A cone that two or
/// three directions on its rim carry is tried for, and grown from the one before as a smallest circle is (E.
/// Welzl, 1991, without the shuffling: there are about five directions).
Vec3 axis_around(const std::vector<Vec3>& directions) {
  const auto outside = [](const Vec3& axis, const Vec3& rim, const Vec3& direction) {
    return axis.dot(direction) < axis.dot(rim) - RIM_TOLERANCE * axis.norm();
  };
  Vec3 axis = directions[0];
  Vec3 rim = directions[0];
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (!outside(axis, rim, directions[i])) continue;
    rim = directions[i];
    axis = directions[0] + rim;
    for (std::size_t j = 1; j < i; ++j) {
      if (!outside(axis, rim, directions[j])) continue;
      axis = directions[j] + rim;
      for (std::size_t k = 0; k < j; ++k) {
        if (!outside(axis, rim, directions[k])) continue;
        axis = (directions[j] - rim).cross(directions[k] - rim);
        if (axis.dot(rim) < 0.0) axis = -axis;
      }
    }
  }
  return axis;
}

std::optional<PolarCap> cap_around(const Extremes& extremes) {
  if (extremes.directions.empty()) return std::nullopt;
  PolarCap cap;
  cap.axis = axis_around(extremes.directions);
  const double length = cap.axis.norm();
  if (!(length > LEAST_AXIS)) return PolarCap{};
  cap.axis /= length;
  // Measured, so that all directions are inside however the axis was found.
  double cosine = 1.0, squared_sine = 0.0;
  for (const Vec3& direction : extremes.directions) {
    cosine = std::min(cosine, cap.axis.dot(direction));
    squared_sine = std::max(squared_sine, cap.axis.cross(direction).squaredNorm());
  }
  // sin and cos of phi + slack, rounded outwards: |d cos|, |d sin| <= slack.
  const double sine = std::sqrt(squared_sine);
  cap.cosine = cosine - (sine * extremes.slack + 0.5 * extremes.slack * extremes.slack);
  cap.sine = std::min(1.0, sine + extremes.slack);
  if (!(cap.cosine > 0.0)) return PolarCap{};
  return cap;
}

/// Whether a direction satisfies all constraints but `i` and `j`, each relaxed by `extra`. A violated
/// constraint moves to the front: it is the likeliest to reject the next candidate.
bool satisfies(std::vector<Constraint>& constraints, std::vector<std::size_t>& order, const Vec3& direction,
               std::size_t i, std::size_t j, double extra) {
  for (std::size_t position = 0; position < order.size(); ++position) {
    const std::size_t k = order[position];
    if (k == i || k == j) continue;
    if (constraints[k].direction.dot(direction) > constraints[k].slack + extra) {
      if (position > 0) std::swap(order[position], order[position / 2]);
      return false;
    }
  }
  return true;
}

/// Scratch memory of one thread: caps are built for every feature of a mesh.
struct Scratch {
  std::vector<Constraint> constraints;
  std::vector<std::size_t> order;
  Extremes extremes;

  void clear() {
    constraints.clear();
    order.clear();
    extremes.directions.clear();
    extremes.slack = 0.0;
  }
};

Scratch& scratch() {
  thread_local Scratch instance;
  instance.clear();
  return instance;
}

/// Which of the two crossings x and -x of planes i and j some other constraint rejects for certain. x need
/// not be unit, and is at least CLEAR_CROSSING long; the constraints have no more slack than POLAR_SLACK.
std::array<bool, 2> clearly_rejected(const std::vector<Constraint>& constraints, const Vec3& x, std::size_t i,
                                     std::size_t j) {
  // Planes that cross at such an angle shift their crossing by less than 2 / CLEAR_CROSSING slacks.
  constexpr double LIMIT = (1.0 + 2.0 / CLEAR_CROSSING) * POLAR_SLACK;
  std::array<bool, 2> rejected{};
  for (std::size_t k = 0; k < constraints.size() && !(rejected[0] && rejected[1]); ++k) {
    if (k == i || k == j) continue;
    const double along = constraints[k].direction.dot(x);
    rejected[0] = rejected[0] || along > LIMIT;
    rejected[1] = rejected[1] || -along > LIMIT;
  }
  return rejected;
}

/// Crossings of two constraints' planes that satisfy all others. False when no two planes cross.
bool find_crossings(Scratch& work) {
  const std::size_t count = work.constraints.size();
  work.order.clear();
  work.extremes.directions.clear();
  work.extremes.slack = 0.0;
  for (std::size_t k = 0; k < count; ++k) work.order.push_back(count - 1 - k);
  bool crossed = false;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3& a = work.constraints[i].direction;
      const Vec3& b = work.constraints[j].direction;
      Vec3 crossing = a.cross(b);
      const double squared_sine = crossing.squaredNorm();
      if (squared_sine < LEAST_CROSSING * LEAST_CROSSING) continue;
      crossed = true;
      std::array<bool, 2> rejected{};
      if (squared_sine > CLEAR_CROSSING * CLEAR_CROSSING)
        rejected = clearly_rejected(work.constraints, crossing, i, j);
      if (rejected[0] && rejected[1]) continue;
      const double sine = std::sqrt(squared_sine);
      crossing /= sine;
      // Relaxed planes cross at most this far from the exact ones: s / cos(half their angle).
      const double half_cosine = std::sqrt(std::max(0.0, 0.5 * (1.0 + a.dot(b))));
      const double shift = POLAR_SLACK / std::max(half_cosine, LEAST_CROSSING);
      for (const std::size_t sign : {0u, 1u}) {
        const Vec3 candidate = sign == 0 ? crossing : Vec3(-crossing);
        if (rejected[sign] || !satisfies(work.constraints, work.order, candidate, i, j, shift)) continue;
        work.extremes.directions.push_back(candidate);
        work.extremes.slack = std::max(work.extremes.slack, POLAR_SLACK + shift);
      }
    }
  }
  return crossed;
}

std::optional<PolarCap> vertex_cap(const Surface& surface, std::int32_t vertex) {
  if (surface.adjacency.vertex_triangles[vertex].empty()) return std::nullopt;
  Scratch& work = scratch();
  const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(vertex)];
  for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
    const Vec3 direction = surface.mesh.vertices[static_cast<std::size_t>(neighbour)] - p;
    const double length = direction.norm();
    if (length > 0.0) work.constraints.push_back({direction / length, POLAR_SLACK});
    return true;
  });
  if (!find_crossings(work)) return PolarCap{};
  if (work.extremes.directions.empty()) return std::nullopt;
  // Saddles are done here, and so are peaks, all of whose directions are outer ones: whether a vertex has an
  // outer side costs a walk round it.
  const Vec3& outer = surface.vertex_pseudo_normals[static_cast<std::size_t>(vertex)];
  const bool all_outer = std::all_of(work.extremes.directions.begin(), work.extremes.directions.end(),
                                     [&](const Vec3& direction) { return direction.dot(outer) >= 0.0; });
  if (!all_outer && has_outer_side(surface, {FeatureKind::VERTEX, vertex})) {
    work.constraints.push_back({-outer, POLAR_SLACK});
    find_crossings(work);
  }
  return cap_around(work.extremes);
}

std::int32_t opposite_corner(const Surface& surface, std::int32_t triangle,
                             const std::array<std::int32_t, 2>& ends) {
  const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
  return *std::find_if(corners.begin(), corners.end() - 1,
                       [&](std::int32_t corner) { return corner != ends[0] && corner != ends[1]; });
}

/// Whether an edge is reflex beyond all slack, so that its cone is empty: half of all edges are, and this
/// needs no root. With a0 and a1 the unit vectors across the edge into its triangles, n0 the normal of the
/// first and theta the angle from a0 to a1 over the outer side, the cone's nearest direction is
/// asin(sin(theta / 2)) away from the outer side, and sin(theta / 2) >= sin(theta) / 2 = a1.n0 / 2. Asked for
/// are 5e-4, against a slack of at most 5e-5 where no triangle is flatter than FLAT.
bool is_clearly_reflex(const Surface& surface, std::int32_t edge) {
  constexpr double LEAST_SINE = 1e-3, FLAT = 10.0;
  const auto e = static_cast<std::size_t>(edge);
  if (surface.edge_is_boundary[e] || surface.edge_is_non_manifold[e]) return false;
  const auto& ends = surface.adjacency.edges[e];
  const auto triangles = surface.adjacency.edge_triangles[edge];
  const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(ends[0])];
  const Vec3 along = surface.mesh.vertices[static_cast<std::size_t>(ends[1])] - p;
  const double squared_length = along.squaredNorm();
  const Vec3& normal = surface.face_normals[static_cast<std::size_t>(triangles[0])];
  double rise = 0.0, squared_height = 0.0;
  for (const std::int32_t triangle : {triangles[0], triangles[1]}) {
    const std::int32_t corner = opposite_corner(surface, triangle, ends);
    const Vec3 to_corner = surface.mesh.vertices[static_cast<std::size_t>(corner)] - p;
    rise = normal.dot(to_corner);
    squared_height = along.cross(to_corner).squaredNorm() / squared_length;
    const double squared_size = 2.0 * (squared_length + to_corner.squaredNorm());
    if (!(FLAT * FLAT * squared_height > squared_size)) return false;
  }
  return rise > 0.0 && rise * rise > LEAST_SINE * LEAST_SINE * squared_height;
}

std::optional<PolarCap> edge_cap(const Surface& surface, std::int32_t edge) {
  if (is_clearly_reflex(surface, edge)) return std::nullopt;
  const auto e = static_cast<std::size_t>(edge);
  const auto& ends = surface.adjacency.edges[e];
  const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(ends[0])];
  Vec3 along = surface.mesh.vertices[static_cast<std::size_t>(ends[1])] - p;
  const double length = along.norm();
  if (!(length > 0.0)) return std::nullopt;
  along /= length;

  Scratch& work = scratch();
  for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge]) {
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
      if (corner == ends[0] || corner == ends[1]) continue;
      const Vec3 to_corner = surface.mesh.vertices[static_cast<std::size_t>(corner)] - p;
      const Vec3 across = to_corner - along.dot(to_corner) * along;
      const double height = across.norm();
      const double size = length + to_corner.norm();
      if (!(height > LEAST_HEIGHT * size)) continue;
      // The first-order test measures n . (x - p) against |x - p|, which is up to `size` for a height of
      // `height`.
      const double slack = POLAR_SLACK * (1.0 + 2.0 * size / height);
      if (slack < LARGEST_SLACK) work.constraints.push_back({across / height, slack});
    }
  }
  if (has_outer_side(surface, {FeatureKind::EDGE, edge}))
    work.constraints.push_back({-surface.pseudo_normal({FeatureKind::EDGE, edge}), POLAR_SLACK});
  if (work.constraints.empty()) return PolarCap{};

  // All planes contain the edge's normal plane's directions only: the cone is an arc, its ends are
  // perpendicular to the constraints.
  const std::size_t count = work.constraints.size();
  for (std::size_t k = 0; k < count; ++k) {
    work.order.push_back(k);
    work.extremes.slack = std::max(work.extremes.slack, 2.0 * work.constraints[k].slack);
  }
  for (std::size_t k = 0; k < count; ++k) {
    Vec3 end = along.cross(work.constraints[k].direction);
    const double end_length = end.norm();
    if (!(end_length > LEAST_CROSSING)) continue;
    end /= end_length;
    for (const Vec3& candidate : {end, Vec3(-end)})
      if (satisfies(work.constraints, work.order, candidate, k, k, work.constraints[k].slack))
        work.extremes.directions.push_back(candidate);
  }
  return cap_around(work.extremes);
}

}  // namespace

std::optional<PolarCap> polar_cap(const Surface& surface, const FeatureId& feature) {
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return vertex_cap(surface, feature.index);
    case FeatureKind::EDGE:
      return edge_cap(surface, feature.index);
    case FeatureKind::FACE:
      break;
  }
  const Vec3& normal = surface.face_normals[static_cast<std::size_t>(feature.index)];
  if (normal.isZero(0.0)) return std::nullopt;
  return PolarCap{normal, 1.0 - 0.5 * POLAR_SLACK * POLAR_SLACK, POLAR_SLACK};
}

}  // namespace lmdbench
