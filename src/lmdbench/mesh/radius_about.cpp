// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/radius_about.h>

#include <algorithm>

namespace lmdbench {

double radius_about(const TriangleMesh& mesh, const Vec3& centre) {
  double radius = 0.0;
  for (const Vec3& vertex : mesh.vertices) radius = std::max(radius, (vertex - centre).norm());
  return radius;
}

}  // namespace lmdbench
