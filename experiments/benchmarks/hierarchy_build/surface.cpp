// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/hierarchy_build/implementation.h>

#include <optional>

namespace lmdbench::experiments {
namespace {

class SurfaceBuild : public HierarchyBuild {
 public:
  explicit SurfaceBuild(const Surface& surface) : mesh_(surface.mesh) {}
  void build() override { built_ = build_surface(mesh_); }
  void clear() override { built_.reset(); }
  /// There is no query: its parts exist or not.
  double error_at(const BuildProbe&) override {
    return built_ && built_->face_normals.size() == mesh_.triangles.size() ? 0.0 : 1.0;
  }

 private:
  const TriangleMesh& mesh_;
  std::optional<Surface> built_;
};

}  // namespace

/// Adjacency and normals, from which both our hierarchies start, with a copy of the mesh.
BuildImplementation surface_build() {
  return {"surface", 0.0, [](const Surface& surface) { return std::make_unique<SurfaceBuild>(surface); }};
}

}  // namespace lmdbench::experiments
