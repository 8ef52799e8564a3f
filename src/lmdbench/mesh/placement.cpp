// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/placement.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

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
  if (diagonal < SMALLEST_DIAGONAL)
    throw InputError(name, "",
                     fmt::format("is {:g} m large, less than {:g}: products of such lengths vanish", diagonal,
                                 SMALLEST_DIAGONAL),
                     REMEDY);
}

Placement read_placement(const nlohmann::json& entry) {
  Placement placement;
  if (entry.contains("diagonal_m")) placement.diagonal = entry["diagonal_m"].get<double>();
  if (entry.contains("scale")) placement.scale = entry["scale"].get<double>();
  if (entry.contains("centre")) placement.centre = entry["centre"].get<bool>();
  return placement;
}

void write_placement(const Placement& placement, nlohmann::ordered_json& entry) {
  if (placement.diagonal) entry["diagonal_m"] = *placement.diagonal;
  if (placement.scale) entry["scale"] = *placement.scale;
  if (placement.centre) entry["centre"] = *placement.centre;
}

TriangleMesh placed(TriangleMesh mesh, const Placement& placement) {
  const double factor = placement.factor(mesh);
  if (placement.diagonal && !(std::isfinite(factor) && factor > 0.0))
    throw InputError("", "", "the mesh has no extent and cannot be scaled",
                     "give a mesh with at least one triangle of some size");
  // Without centre and scale the coordinates keep their bits: less 0, times 1.
  const Vec3 origin = placement.centres() ? bounding_box_centre(mesh) : Vec3::Zero();
  for (Vec3& vertex : mesh.vertices) vertex = factor * (vertex - origin);
  mesh.planar_tolerance *= factor;
  refuse_extreme_size(mesh, "");
  return mesh;
}

}  // namespace lmdbench
