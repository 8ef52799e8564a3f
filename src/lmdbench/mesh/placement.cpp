// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/placement.h>

#include <fmt/format.h>

namespace lmdbench {

void refuse_extreme_size(const TriangleMesh& mesh, const std::string& name) {
  constexpr const char* REMEDY = "scale the mesh: coordinates are metres";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!(mesh.vertices[v].cwiseAbs().maxCoeff() <= LARGEST_COORDINATE))
      throw InputError(
          name, fmt::format("vertex {}", v),
          fmt::format("has a coordinate above {:g}: products of such lengths overflow", LARGEST_COORDINATE),
          REMEDY);
  const double diagonal = bounding_box_diagonal(mesh);
  if (diagonal > 0.0 && diagonal < SMALLEST_DIAGONAL)
    throw InputError(name, "",
                     fmt::format("is {:g} m large, less than {:g}: products of such lengths vanish", diagonal,
                                 SMALLEST_DIAGONAL),
                     REMEDY);
}

}  // namespace lmdbench
