// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>
#include <lmdbench/mesh/polar_cone.h>
#include <lmdbench/snch/polar_cap.h>

#include <algorithm>
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
/// A constraint that is looser than this (a sine) is dropped; caps of needle-like triangles get wider, never
/// wrong.
constexpr double LARGEST_SLACK = 0.1;
/// Heights of triangles below this part of their length are rounding: such a triangle constrains nothing.
constexpr double LEAST_HEIGHT = 1e-12;

/// Extreme directions of a polar cone, and what must be added to their spread.
struct Extremes {
  std::vector<Vec3> directions;
  double slack = 0.0;
};

std::optional<PolarCap> cap_around(const Extremes& extremes) {
  if (extremes.directions.empty()) return std::nullopt;
  const Cone cone = cone_of_directions(extremes.directions);
  PolarCap cap;
  cap.axis = cone.axis;
  // sin and cos of phi + slack, rounded outwards: |d cos|, |d sin| <= slack.
  cap.cosine = cone.cosine - (cone.sine * extremes.slack + 0.5 * extremes.slack * extremes.slack);
  cap.sine = std::min(1.0, cone.sine + extremes.slack);
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
      const double sine = crossing.norm();
      if (sine < LEAST_CROSSING) continue;
      crossed = true;
      crossing /= sine;
      // Relaxed planes cross at most this far from the exact ones: s / cos(half their angle).
      const double half_cosine = std::sqrt(std::max(0.0, 0.5 * (1.0 + a.dot(b))));
      const double shift = POLAR_SLACK / std::max(half_cosine, LEAST_CROSSING);
      for (const Vec3& candidate : {crossing, Vec3(-crossing)}) {
        if (!satisfies(work.constraints, work.order, candidate, i, j, shift)) continue;
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
  for (const std::int32_t edge : surface.adjacency.vertex_edges[vertex]) {
    const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
    Vec3 direction =
        surface.mesh.vertices[static_cast<std::size_t>(ends[0] == vertex ? ends[1] : ends[0])] - p;
    const double length = direction.norm();
    if (length > 0.0) work.constraints.push_back({direction / length, POLAR_SLACK});
  }
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

std::optional<PolarCap> edge_cap(const Surface& surface, std::int32_t edge) {
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
    work.constraints.push_back({-surface.edge_pseudo_normals[e], POLAR_SLACK});
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
