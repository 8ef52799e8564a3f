// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <judge/exact_scene_body.h>

#include <algorithm>
#include <cmath>

namespace lmdbench::exact {

WorldBody::WorldBody(const Surface& surface, const RigidTransform& X_WS) : surface_(surface) {
  vertices_W_.reserve(surface.mesh.vertices.size());
  for (const Vec3& vertex : surface.mesh.vertices) vertices_W_.push_back(X_WS.point(vertex));
  on_non_manifold_edge_.assign(surface.mesh.vertices.size(), false);
  for (std::size_t i = 0; i < surface.adjacency.edges.size(); ++i) {
    if (!surface.edge_is_non_manifold[i]) continue;
    for (const std::int32_t vertex : surface.adjacency.edges[i])
      on_non_manifold_edge_[static_cast<std::size_t>(vertex)] = true;
  }
}

Triangle WorldBody::triangle(std::int32_t index) const {
  const auto& [a, b, c] = corners(index);
  return {vertex(a), vertex(b), vertex(c)};
}

bool WorldBody::has_side(const FeatureId& feature) const {
  if (feature.kind == FeatureKind::FACE) return true;
  if (surface_.is_boundary(feature)) return false;
  if (feature.kind == FeatureKind::EDGE)
    return !surface_.edge_is_non_manifold[static_cast<std::size_t>(feature.index)];
  return !on_non_manifold_edge_[static_cast<std::size_t>(feature.index)];
}

bool WorldBody::on_flat_triangle(const FeatureId& feature) const {
  const auto triangles = surface_.incident_triangles(feature);
  return std::any_of(triangles.begin(), triangles.end(), [&](std::int32_t index) {
    const Triangle t = triangle(index);
    const Vec3 u = t[1] - t[0], v = t[2] - t[0];
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    return !(u.cross(v).norm() > UNCERTAIN_SINE * longest);
  });
}

bool WorldBody::on_outer_side_of_vertex(std::int32_t vertex_index, const Vec3& direction_W,
                                        bool& certain) const {
  using Wide = Eigen::Matrix<long double, 3, 1>;
  const Wide direction = direction_W.cast<long double>();
  long double sum = 0.0L, weights = 0.0L;
  for (const std::int32_t triangle : surface_.adjacency.vertex_triangles[vertex_index]) {
    auto order = corners(triangle);
    while (order[0] != vertex_index) std::rotate(order.begin(), order.begin() + 1, order.end());
    const Wide p = vertex(vertex_index).cast<long double>();
    const Wide u = vertex(order[1]).cast<long double>() - p, v = vertex(order[2]).cast<long double>() - p;
    const Wide n = u.cross(v);
    const long double doubled_area = n.norm();
    if (doubled_area == 0.0L) continue;
    const long double angle = std::atan2(doubled_area, u.dot(v));
    sum += angle * n.dot(direction) / doubled_area;
    weights += angle;
  }
  if (!(std::abs(sum) > static_cast<long double>(UNCERTAIN_SINE) * weights * direction.norm()))
    certain = false;
  return sum > 0.0L;
}

}  // namespace lmdbench::exact
