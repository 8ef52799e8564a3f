// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/mesh/polar_cone.h>
#include <lmdbench/mesh/triangle_normal.h>
#include <lmdbench/mesh/vertex_fan.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

const Vec3& vertex_of(const Surface& surface, std::int32_t index) {
  return surface.mesh.vertices[static_cast<std::size_t>(index)];
}

void add_direction(std::vector<Vec3>& directions, const Vec3& from, const Vec3& to) {
  const Vec3 direction = (to - from).stableNormalized();
  if (!direction.isZero(0.0)) directions.push_back(direction);
}

std::vector<Vec3> directions_from_vertex(const Surface& surface, std::int32_t vertex) {
  std::vector<Vec3> directions;
  for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
    add_direction(directions, vertex_of(surface, vertex), vertex_of(surface, neighbour));
    return true;
  });
  return directions;
}

// Along the edge both ways, and to the third corner of every triangle. The latter is seen from the edge's end
// where it stands at the flattest angle: a tolerance on the sine then allows the most, so no direction that
// passes the test at some point of the edge is lost. Empty for an edge without length.
std::vector<Vec3> directions_from_edge(const Surface& surface, std::int32_t edge) {
  std::vector<Vec3> directions;
  const auto [tail, head] = surface.adjacency.edges[static_cast<std::size_t>(edge)];
  const Vec3& a = vertex_of(surface, tail);
  const Vec3& b = vertex_of(surface, head);
  if (a == b) return directions;
  add_direction(directions, a, b);
  add_direction(directions, b, a);
  for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge]) {
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
      if (corner == tail || corner == head) continue;
      const Vec3& c = vertex_of(surface, corner);
      const bool farther_from_a = (c - a).squaredNorm() >= (c - b).squaredNorm();
      add_direction(directions, farther_from_a ? a : b, c);
    }
  }
  return directions;
}

std::vector<Vec3> generators(const Surface& surface, const FeatureId& feature, bool first_only) {
  LMDBENCH_EXPECTS(feature.index >= 0, "a feature that was never set");
  if (surface.incident_triangles(feature).empty()) return {};
  if (feature.kind == FeatureKind::FACE) {
    const Vec3 normal = surface.pseudo_normal(feature);
    return normal.isZero(0.0) ? std::vector<Vec3>{} : std::vector<Vec3>{normal};
  }
  std::vector<Vec3> directions;
  if (feature.kind == FeatureKind::VERTEX) {
    directions = directions_from_vertex(surface, feature.index);
  } else {
    directions = directions_from_edge(surface, feature.index);
    if (directions.empty()) return {};
  }
  const Vec3 outer = has_outer_side(surface, feature) ? surface.pseudo_normal(feature) : Vec3::Zero();
  return polar_rays(directions, outer, POLAR_CONE_TOLERANCE, first_only);
}

}  // namespace

bool has_outer_side(const Surface& surface, const FeatureId& feature) {
  if (surface.is_boundary(feature) || surface.pseudo_normal(feature).isZero(0.0)) return false;
  if (feature.kind == FeatureKind::EDGE)
    return !surface.edge_is_non_manifold[static_cast<std::size_t>(feature.index)];
  if (feature.kind == FeatureKind::VERTEX) return !is_non_manifold_vertex(surface, feature.index);
  return true;
}

PolarCone polar_cone(const Surface& surface, const FeatureId& feature) {
  return {generators(surface, feature, false)};
}

bool has_polar_cone(const Surface& surface, const FeatureId& feature) {
  return !generators(surface, feature, true).empty();
}

std::vector<FeatureId> features_with_polar_cones(const Surface& surface) {
  std::vector<FeatureId> features;
  const auto add = [&](FeatureKind kind, std::size_t count) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i)
      if (has_polar_cone(surface, {kind, i})) features.push_back({kind, i});
  };
  add(FeatureKind::VERTEX, surface.mesh.vertices.size());
  add(FeatureKind::EDGE, surface.adjacency.edges.size());
  add(FeatureKind::FACE, surface.mesh.triangles.size());
  return features;
}

bool in_polar_cone(const Surface& surface, const FeatureId& feature, const Vec3& p_M, const Vec3& d_M,
                   double tolerance) {
  const auto triangles = surface.incident_triangles(feature);
  if (triangles.empty()) return false;
  if (feature.kind == FeatureKind::FACE && surface.pseudo_normal(feature).isZero(0.0)) return false;
  const Vec3 direction = d_M.stableNormalized();
  if (has_outer_side(surface, feature) && !(direction.dot(surface.pseudo_normal(feature)) > 0.0))
    return false;
  return std::all_of(triangles.begin(), triangles.end(), [&](std::int32_t triangle) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
    return std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
      if (feature.kind == FeatureKind::VERTEX && corner == feature.index) return true;
      return direction.dot((vertex_of(surface, corner) - p_M).stableNormalized()) <= tolerance;
    });
  });
}

namespace {

// Two directions whose cross product is below this are one to rounding (unit vectors carry about half an ulp
// a component); their circles coincide far within any tolerance that is used.
constexpr double PARALLEL_SINE = 8.0 * std::numeric_limits<double>::epsilon();

// Crossings are right to rounding; this much slack on the tolerance keeps directions that coincide with one
// of the two that cross.
constexpr double CROSSING_SLACK = 1.01;

// Cosine of the width from which an arc gets a ray in its middle: a little over a right angle, so that
// corners of boxes need none.
constexpr double WIDE_ARC_COSINE = -0.1;

class RaySearch {
 public:
  RaySearch(std::span<const Vec3> directions, const Vec3& outer, double tolerance, bool first_only)
      : directions_(directions), outer_(outer), tolerance_(tolerance), first_only_(first_only) {}

  std::vector<Vec3> run() {
    if (directions_.empty()) {
      offer_axes({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {});
    } else if (all_parallel()) {
      const Vec3& e = directions_.front();
      const Vec3 u = e.unitOrthogonal();
      offer_axes({u, e.cross(u)}, {e, Vec3(-e)});
    } else {
      on_circle_.resize(directions_.size());
      if (find_crossings() && !first_only_) find_rays_between();
    }
    return std::move(rays_);
  }

 private:
  bool all_parallel() const {
    return std::all_of(directions_.begin(), directions_.end(), [&](const Vec3& e) {
      return accurate_cross(directions_.front(), e).norm() <= PARALLEL_SINE;
    });
  }

  // Half-space, plane or whole space: both signs of what spans it.
  void offer_axes(std::initializer_list<Vec3> two_sided, std::initializer_list<Vec3> one_sided) {
    for (const Vec3& axis : two_sided) {
      offer(axis);
      offer(-axis);
    }
    for (const Vec3& axis : one_sided) offer(axis);
  }

  bool is_inside(const Vec3& n) {
    if (n.dot(outer_) < -tolerance_) return false;
    const double limit = CROSSING_SLACK * tolerance_;
    if (n.dot(directions_[last_rejection_]) > limit) return false;
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      if (n.dot(directions_[k]) > limit) {
        last_rejection_ = k;
        return false;
      }
    }
    return true;
  }

  bool offer(const Vec3& n) {
    if (!directions_.empty() && !is_inside(n)) return false;
    if (directions_.empty() && n.dot(outer_) < -tolerance_) return false;
    rays_.push_back(n);
    return true;
  }

  // Unit vectors with n . a = n . b = tolerance: n = alpha (a + b) + beta (a x b).
  // @return whether there are any rays
  bool find_crossings() {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      for (std::size_t j = i + 1; j < directions_.size(); ++j) {
        const Vec3& a = directions_[i];
        const Vec3& b = directions_[j];
        const Vec3 cross = accurate_cross(a, b);
        const double sine = cross.norm();
        if (sine <= PARALLEL_SINE) continue;
        // |a + b|^2 / 2 rather than 1 + a . b, which loses its digits for opposite directions.
        const Vec3 sum = a + b;
        const double one_plus_cosine = 0.5 * sum.squaredNorm();
        const double height_squared = 1.0 - 2.0 * tolerance_ * tolerance_ / one_plus_cosine;
        if (!(height_squared > 0.0)) continue;  // a band between opposite circles: they do not cross
        const Vec3 middle = (tolerance_ / one_plus_cosine) * sum;
        const Vec3 height = (std::sqrt(height_squared) / sine) * cross;
        for (const Vec3& n : {Vec3(middle + height), Vec3(middle - height)}) {
          if (!offer(n)) continue;
          if (first_only_) return true;
          on_circle_[i].push_back(rays_.size() - 1);
          on_circle_[j].push_back(rays_.size() - 1);
        }
      }
    }
    return !rays_.empty();
  }

  // Where a circle bounds the set over a wide arc, adds the middle of that arc: the arc's ends
  // alone span nothing once they are opposite (boundary edges and vertices).
  void find_rays_between() {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const auto& rays = on_circle_[i];
      if (rays.size() < 2) continue;
      const auto farthest_from = [&](std::size_t from) {
        return *std::min_element(rays.begin(), rays.end(), [&](std::size_t a, std::size_t b) {
          return rays_[a].dot(rays_[from]) < rays_[b].dot(rays_[from]);
        });
      };
      // On an arc of at most half a circle the point farthest from any point is an end.
      const std::size_t one_end = farthest_from(rays.front());
      const std::size_t other_end = farthest_from(one_end);
      if (rays_[one_end].dot(rays_[other_end]) >= WIDE_ARC_COSINE) continue;
      const Vec3 middle = directions_[i].cross(rays_[one_end] - rays_[other_end]).normalized();
      if (!offer(middle)) offer(-middle);
    }
  }

  std::span<const Vec3> directions_;
  Vec3 outer_;
  double tolerance_;
  bool first_only_;
  std::size_t last_rejection_ = 0;
  std::vector<Vec3> rays_;
  std::vector<std::vector<std::size_t>> on_circle_;
};

// Up to so many directions all crossings are tried; beyond, those of a subset.
constexpr std::size_t FEW_DIRECTIONS = 128;

// A ray that leaves the set by less than this many tolerances is good enough.
constexpr double GOOD_ENOUGH = 2.0;

// Where the subset may start: the directions that reach farthest along these.
std::vector<Vec3> probes() {
  std::vector<Vec3> axes;
  for (const int x : {-1, 0, 1})
    for (const int y : {-1, 0, 1})
      for (const int z : {-1, 0, 1})
        if (x != 0 || y != 0 || z != 0) axes.push_back(Vec3(x, y, z));
  return axes;
}

std::size_t farthest_along(std::span<const Vec3> directions, const Vec3& n) {
  return static_cast<std::size_t>(
      std::max_element(directions.begin(), directions.end(),
                       [&](const Vec3& a, const Vec3& b) { return a.dot(n) < b.dot(n); }) -
      directions.begin());
}

// The directions that bound the set, or enough of them: fewer directions give a larger set, so that the rays of
// any subset cover it. The subset grows by the directions that its rays violate most.
std::vector<Vec3> rays_of_many(std::span<const Vec3> directions, const Vec3& outer, double tolerance,
                               bool first_only) {
  std::vector<bool> taken(directions.size(), false);
  std::vector<Vec3> subset;
  const auto take = [&](std::size_t i) {
    if (taken[i]) return;
    taken[i] = true;
    subset.push_back(directions[i]);
  };
  for (const Vec3& probe : probes()) take(farthest_along(directions, probe));
  while (true) {
    std::vector<Vec3> rays = RaySearch(subset, outer, tolerance, false).run();
    if (rays.empty()) return rays;
    std::vector<Vec3> candidates = rays;
    Vec3 centre = Vec3::Zero();
    for (const Vec3& ray : rays) centre += ray;
    if (centre.norm() > PARALLEL_SINE) candidates.push_back(centre.normalized());
    bool some_inside = false;
    bool all_good = true;
    const std::size_t size_before = subset.size();
    for (const Vec3& n : candidates) {
      const std::size_t worst = farthest_along(directions, n);
      const double excess = n.dot(directions[worst]);
      some_inside = some_inside || excess <= CROSSING_SLACK * tolerance;
      if (excess <= GOOD_ENOUGH * tolerance) continue;
      all_good = false;
      take(worst);
    }
    const bool not_empty = some_inside && (first_only || subset.size() > FEW_DIRECTIONS);
    if (all_good || not_empty || subset.size() == size_before) return rays;
  }
}

}  // namespace

std::vector<Vec3> polar_rays(std::span<const Vec3> directions, const Vec3& outer, double tolerance,
                             bool first_only) {
  if (directions.size() > FEW_DIRECTIONS) return rays_of_many(directions, outer, tolerance, first_only);
  return RaySearch(directions, outer, tolerance, first_only).run();
}

}  // namespace lmdbench
