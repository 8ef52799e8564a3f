// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/triangle_distance.h>

#include <benchmarks/hierarchy_build/implementation.h>
#include <fmt/core.h>
#include <support/random.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::experiments {
namespace {

constexpr std::uint64_t SEED = 7;
/// Shares of the mesh's diagonal: size of a probe, largest distance from the bounding sphere.
constexpr double PROBE_SIZE = 0.02, FARTHEST = 0.5;

}  // namespace

double relative_error(double distance, double truth) {
  return std::abs(distance - truth) / truth;
}

std::vector<BuildProbe> build_probes(const TriangleMesh& mesh, std::size_t count) {
  Random random(SEED);
  const double diagonal = bounding_box_diagonal(mesh);
  const Vec3 centre = bounding_box_centre(mesh);
  std::vector<BuildProbe> probes(count);
  for (BuildProbe& probe : probes) {
    // Outside the bounding sphere, so that no probe meets the mesh.
    const double distance = (0.5 + PROBE_SIZE + FARTHEST * random.uniform()) * diagonal;
    const Vec3 position = centre + distance * random.direction();
    const Eigen::Quaterniond rotation = random.rotation();
    probe.box = make_box(Vec3::Constant(PROBE_SIZE * diagonal / std::sqrt(3.0)));
    for (Vec3& vertex : probe.box.vertices) vertex = position + rotation * vertex;
    double from_box = std::numeric_limits<double>::infinity(), from_corner = from_box;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle triangle = mesh.triangle(static_cast<std::int32_t>(t));
      for (std::size_t side = 0; side < probe.box.triangles.size(); ++side)
        from_box = std::min(from_box,
                            triangle_distance(triangle, probe.box.triangle(static_cast<std::int32_t>(side)))
                                .squared_distance);
      from_corner =
          std::min(from_corner, point_triangle_distance(probe.box.vertices[0], triangle).squared_distance);
    }
    probe.distance_from_box = std::sqrt(from_box);
    probe.distance_from_corner = std::sqrt(from_corner);
  }
  return probes;
}

std::string check_build(const BuildImplementation& implementation, HierarchyBuild& build,
                        const std::vector<BuildProbe>& probes) {
  build.build();
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double error = build.error_at(probes[i]);
    // Written so that NaN objects.
    if (!(error <= implementation.tolerance))
      return fmt::format("probe {}: distance off by {:.2g} of itself", i, error);
  }
  return {};
}

}  // namespace lmdbench::experiments
