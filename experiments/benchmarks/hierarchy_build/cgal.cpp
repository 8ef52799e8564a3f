// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/cgal_tree.h>
#include <benchmarks/hierarchy_build/implementation.h>

#include <optional>

namespace lmdbench::experiments {
namespace {

class CgalBuild : public HierarchyBuild {
 public:
  explicit CgalBuild(const Surface& surface) : mesh_(surface.mesh) {}
  void build() override { built_.emplace(mesh_); }
  void clear() override { built_.reset(); }
  double error_at(const BuildProbe& probe) override {
    return relative_error(built_->distance(probe.box.vertices[0]), probe.distance_from_corner);
  }

 private:
  const TriangleMesh& mesh_;
  std::optional<CgalTree> built_;
};

}  // namespace

/// CGAL's tree of boxes, with the copy into its triangles; without the points for queries without
/// hint, which it makes at the first such query.
BuildImplementation cgal_build() {
  return {"cgal-aabb", 1e-9, [](const Surface& surface) { return std::make_unique<CgalBuild>(surface); }};
}

}  // namespace lmdbench::experiments
