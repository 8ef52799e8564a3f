// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <algorithm>

namespace lmdbench {

Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

double bounding_box_diagonal(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  return bounding_box(mesh).diagonal().stableNorm();
}

double mean_edge_length(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle corners = mesh.triangle(static_cast<std::int32_t>(t));
    for (std::size_t k = 0; k < 3; ++k) sum += (corners[(k + 1) % 3] - corners[k]).stableNorm();
  }
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

Vec3 bounding_box_centre(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return Vec3::Zero();
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  return box.min() + 0.5 * box.diagonal();
}

double radius_about(const TriangleMesh& mesh, const Vec3& centre) {
  LMDBENCH_EXPECTS(centre.allFinite(), "the middle of a mesh without vertices");
  double radius = 0.0;
  for (const Vec3& vertex : mesh.vertices) radius = std::max(radius, (vertex - centre).norm());
  return radius;
}

}  // namespace lmdbench
