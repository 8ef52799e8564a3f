// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>
#include <lmdbench/geometry/sphere.h>
#include <lmdbench/snch/hierarchy.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace lmdbench {
namespace {

/// Triangles whose normals the cone of a leaf covers; some may be visited twice.
template <class Visitor>
void visit_covered(const Surface& surface, std::int32_t triangle, LeafCones leaf_cones, Visitor&& visit) {
  const auto t = static_cast<std::size_t>(triangle);
  if (leaf_cones != LeafCones::ONE_RING) visit(triangle);
  if (leaf_cones == LeafCones::EDGE_NEIGHBOURS)
    for (const std::int32_t edge : surface.adjacency.triangle_edges[t])
      for (const std::int32_t neighbour : surface.adjacency.edge_triangles[edge]) visit(neighbour);
  if (leaf_cones == LeafCones::ONE_RING)
    for (const std::int32_t corner : surface.mesh.triangles[t])
      for (const std::int32_t neighbour : surface.adjacency.vertex_triangles[corner]) visit(neighbour);
}

/// Cone of a leaf. Decision E1, ours: by default it covers the normals of all faces round the
/// triangle's three corners, because the outward direction of an LMD on an edge or at a vertex lies
/// between the normals of its faces. That hull holds the polar cone of every feature of a closed
/// surface. On a boundary, at non-manifold edges and next to triangles without area it does not:
/// all directions.
Cone leaf_cone(const Surface& surface, std::int32_t triangle, LeafCones leaf_cones,
               std::vector<Vec3>& normals) {
  for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
    if (surface.vertex_is_boundary[static_cast<std::size_t>(corner)]) return {};
    if (surface.vertex_has_non_manifold_edge[static_cast<std::size_t>(corner)]) return {};
  }
  normals.clear();
  bool degenerate = false;
  visit_covered(surface, triangle, leaf_cones, [&](std::int32_t covered) {
    normals.push_back(surface.face_normals[static_cast<std::size_t>(covered)]);
    degenerate = degenerate || normals.back().isZero(0.0);
  });
  return degenerate ? Cone{} : convex_cone_of_directions(normals);
}

/// Cone of an inner node: the axis is the average of the leaf axes below it (paper, section 3.1),
/// or that of the children's merged cones where this gives a smaller cone.
Cone node_cone(const Cone& merged_children, std::span<const std::int32_t> triangles,
               std::span<const Cone> leaf_cones, std::span<const double> leaf_half_angles) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t t : triangles) {
    const Cone& cone = leaf_cones[static_cast<std::size_t>(t)];
    if (cone.is_all_directions()) return cone;
    sum += cone.axis;
  }
  // Opposite normals cancel to noise; the merged cone is as good as any axis.
  if (!(sum.norm() > 1e-6 * static_cast<double>(triangles.size()))) return merged_children;
  const Vec3 axis = sum.normalized();
  double half_angle = 0.0;
  for (const std::int32_t t : triangles) {
    const double cosine = std::clamp(axis.dot(leaf_cones[static_cast<std::size_t>(t)].axis), -1.0, 1.0);
    half_angle = std::max(half_angle, std::acos(cosine) + leaf_half_angles[static_cast<std::size_t>(t)]);
  }
  if (half_angle >= merged_children.half_angle()) return merged_children;
  // acos loses half the digits near 0; merging with a degenerate cone would not widen enough.
  constexpr double ROUNDING = 4e-8;
  half_angle += ROUNDING;
  return {axis, std::cos(half_angle), std::sin(half_angle)};
}

class Builder {
 public:
  Builder(const Surface& surface, LeafCones leaf_cones)
      : surface_(surface),
        order_(surface.mesh.triangles.size()),
        centroids_(surface.mesh.triangles.size()),
        gathered_for_(surface.mesh.vertices.size(), -1) {
    std::iota(order_.begin(), order_.end(), 0);
    std::vector<Vec3> normals;
    for (std::size_t t = 0; t < order_.size(); ++t) {
      const Triangle corners = surface.mesh.triangle(static_cast<std::int32_t>(t));
      centroids_[t] = (corners[0] + corners[1] + corners[2]) / 3.0;
      leaf_cones_.push_back(leaf_cone(surface, static_cast<std::int32_t>(t), leaf_cones, normals));
      leaf_half_angles_.push_back(leaf_cones_.back().half_angle());
    }
  }

  Hierarchy build() {
    if (order_.empty()) return {};
    hierarchy_.nodes.reserve(2 * order_.size() - 1);
    hierarchy_.nodes.emplace_back();
    build_node(0, 0, order_.size());
    return std::move(hierarchy_);
  }

 private:
  /// Fills node `index` with the triangles order_[begin, end) and returns its cone.
  Cone build_node(std::size_t index, std::size_t begin, std::size_t end) {
    const std::span<std::int32_t> triangles(order_.data() + begin, end - begin);
    Cone cone;
    std::int32_t first_child = -1;
    if (triangles.size() == 1) {
      cone = leaf_cones_[static_cast<std::size_t>(triangles[0])];
    } else {
      const std::size_t middle = begin + split(triangles);
      first_child = static_cast<std::int32_t>(hierarchy_.nodes.size());
      hierarchy_.nodes.resize(hierarchy_.nodes.size() + 2);
      const Cone left = build_node(static_cast<std::size_t>(first_child), begin, middle);
      const Cone right = build_node(static_cast<std::size_t>(first_child) + 1, middle, end);
      cone = node_cone(merge_cones(left, right), triangles, leaf_cones_, leaf_half_angles_);
    }
    gather_corners(triangles, static_cast<std::int32_t>(index));
    const Sphere sphere = bounding_sphere(points_);
    hierarchy_.nodes[index] = {sphere.centre,
                               sphere.radius,
                               cone.axis,
                               cone.cosine,
                               cone.sine,
                               first_child,
                               triangles.size() == 1 ? triangles[0] : -1};
    return cone;
  }

  /// Collects the triangles' corners in points_, once each: triangles share theirs with some five.
  void gather_corners(std::span<const std::int32_t> triangles, std::int32_t node) {
    points_.clear();
    for (const std::int32_t t : triangles)
      for (const std::int32_t vertex : surface_.mesh.triangles[static_cast<std::size_t>(t)]) {
        std::int32_t& last = gathered_for_[static_cast<std::size_t>(vertex)];
        if (last == node) continue;
        last = node;
        points_.push_back(surface_.mesh.vertices[static_cast<std::size_t>(vertex)]);
      }
  }

  /// Sorts the triangles into two halves along the longest side of their centroids' box and returns
  /// the size of the first. Ties are broken by index: the hierarchy depends on the mesh alone.
  std::size_t split(std::span<std::int32_t> triangles) {
    Eigen::AlignedBox3d box;
    for (const std::int32_t t : triangles) box.extend(centroids_[static_cast<std::size_t>(t)]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t half = triangles.size() / 2;
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                     triangles.end(), [&](std::int32_t a, std::int32_t b) {
                       const double position_a = centroids_[static_cast<std::size_t>(a)][axis];
                       const double position_b = centroids_[static_cast<std::size_t>(b)][axis];
                       return position_a != position_b ? position_a < position_b : a < b;
                     });
    return half;
  }

  const Surface& surface_;
  Hierarchy hierarchy_;
  std::vector<std::int32_t> order_;  ///< Triangles; every node owns a range of it.
  std::vector<Vec3> centroids_;
  std::vector<Cone> leaf_cones_;
  std::vector<double> leaf_half_angles_;
  std::vector<Vec3> points_;
  std::vector<std::int32_t> gathered_for_;  ///< Last node that gathered each vertex.
};

}  // namespace

Hierarchy Hierarchy::of(const Surface& surface) {
  return hierarchy_with(surface, LeafCones::ONE_RING);
}

Hierarchy hierarchy_with(const Surface& surface, LeafCones leaf_cones) {
  return Builder(surface, leaf_cones).build();
}

}  // namespace lmdbench
