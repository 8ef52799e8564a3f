// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>

#include <benchmarks/embree_mesh.h>
#include <benchmarks/hierarchy_build/implementation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench::experiments {
namespace {

class EmbreeBuild : public HierarchyBuild {
 public:
  explicit EmbreeBuild(const Surface& surface) : mesh_(surface.mesh) {}
  void build() override { built_.emplace(mesh_); }
  void clear() override { built_.reset(); }
  double error_at(const BuildProbe& probe) override {
    const Vec3& point = probe.box.vertices[0];
    double least = std::numeric_limits<double>::infinity();
    built_->for_each_near(point, least, [&](std::int32_t triangle) {
      least = std::min(least,
                       std::sqrt(point_triangle_distance(point, mesh_.triangle(triangle)).squared_distance));
      return least;
    });
    return relative_error(least, probe.distance_from_corner);
  }

 private:
  const TriangleMesh& mesh_;
  std::optional<EmbreeMesh> built_;
};

}  // namespace

/// Embree's hierarchy: single precision, own device, copy into its buffers. Uses all cores.
BuildImplementation embree_build() {
  return {"embree", 1e-9, [](const Surface& surface) { return std::make_unique<EmbreeBuild>(surface); }};
}

}  // namespace lmdbench::experiments
