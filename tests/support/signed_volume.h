// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench::testing {

/// Volume of a closed mesh, in its unit cubed; positive if its normals point outwards.
inline double signed_volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle corners = mesh.triangle(static_cast<std::int32_t>(t));
    sum += corners[0].dot(corners[1].cross(corners[2])) / 6.0;
  }
  return sum;
}

}  // namespace lmdbench::testing
