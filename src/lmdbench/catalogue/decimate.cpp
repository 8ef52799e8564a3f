// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/decimate.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/mesh/validity.h>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

// meshoptimizer stops before the target only where it can collapse nothing more; beyond this
// tolerance the name "16k" would be wrong.
constexpr double TARGET_TOLERANCE = 0.01;

// Relative error at which meshoptimizer stops before the target. Its quadric error of a closed mesh
// stays far below the mesh's extent, so with 1 the target decides.
constexpr float NO_ERROR_LIMIT = 1.0f;

std::string broken_property(const ValidityReport& before, const ValidityReport& after) {
  if (before.closed && !after.closed) return "closed";
  if (before.manifold && !after.manifold) return "manifold";
  if (before.consistently_oriented && !after.consistently_oriented) return "consistently oriented";
  if (after.degenerate_triangles > before.degenerate_triangles) return "free of degenerate triangles";
  if (after.duplicate_triangles > before.duplicate_triangles) return "free of duplicate triangles";
  return {};
}

}  // namespace

Decimation decimate(const TriangleMesh& mesh, std::int32_t target_triangles, const std::string& name) {
  const auto target = static_cast<std::size_t>(std::max(target_triangles, 0));
  if (target >= mesh.triangles.size()) return {mesh, 0.0};

  // Centred and at unit size, to spend single precision on the shape.
  const Vec3 centre = bounding_box_centre(mesh);
  const double diagonal = bounding_box_diagonal(mesh);
  std::vector<float> positions;
  positions.reserve(3 * mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis)
      positions.push_back(static_cast<float>((vertex[axis] - centre[axis]) / diagonal));
  std::vector<unsigned int> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t corner : corners) indices.push_back(static_cast<unsigned int>(corner));

  std::vector<unsigned int> kept(indices.size());
  float error = 0.0f;
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), positions.data(),
                               mesh.vertices.size(), 3 * sizeof(float), 3 * target, NO_ERROR_LIMIT, 0,
                               &error));

  Decimation result;
  result.relative_error = static_cast<double>(error);
  result.mesh.vertices = mesh.vertices;
  for (std::size_t i = 0; i + 2 < kept.size(); i += 3)
    result.mesh.triangles.push_back({static_cast<std::int32_t>(kept[i]),
                                     static_cast<std::int32_t>(kept[i + 1]),
                                     static_cast<std::int32_t>(kept[i + 2])});
  result.mesh = welded(result.mesh);

  const auto count = static_cast<double>(result.mesh.triangles.size());
  if (std::abs(count - static_cast<double>(target)) > TARGET_TOLERANCE * static_cast<double>(target))
    throw InputError(name, "", fmt::format("decimation stops at {} triangles, target {}", count, target),
                     "choose a larger target");
  const std::string broken =
      broken_property(check_mesh(build_surface(mesh)), check_mesh(build_surface(result.mesh)));
  if (!broken.empty())
    throw InputError(name, "",
                     fmt::format("is not {} any more when decimated to {} triangles", broken, count),
                     "choose a larger target");
  return result;
}

}  // namespace lmdbench
