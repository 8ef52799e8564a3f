// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/hierarchy_build/implementation.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

namespace lmdbench::experiments {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::unique_ptr<Model> build_model(const std::vector<Vec3>& vertices,
                                   const std::vector<fcl::Triangle>& triangles) {
  auto model = std::make_unique<Model>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

std::vector<fcl::Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& corners : mesh.triangles) triangles.emplace_back(corners[0], corners[1], corners[2]);
  return triangles;
}

class FclBuild : public HierarchyBuild {
 public:
  /// FCL treats small triangles as empty (crosscheck/fcl_crosscheck.h), so edges get a length of 1.
  explicit FclBuild(const Surface& surface)
      : scale_(1.0 / mean_edge_length(surface.mesh)),
        vertices_(scaled_vertices(surface.mesh)),
        triangles_(triangles_of(surface.mesh)) {}
  void build() override { model_ = build_model(vertices_, triangles_); }
  void clear() override { model_.reset(); }
  double error_at(const BuildProbe& probe) override {
    const auto other = build_model(scaled_vertices(probe.box), triangles_of(probe.box));
    fcl::DistanceResultd result;
    fcl::distance(model_.get(), fcl::Transform3d(fcl::Transform3d::Identity()), other.get(),
                  fcl::Transform3d(fcl::Transform3d::Identity()), fcl::DistanceRequestd(), result);
    return relative_error(result.min_distance / scale_, probe.distance_from_box);
  }

 private:
  std::vector<Vec3> scaled_vertices(const TriangleMesh& mesh) const {
    std::vector<Vec3> vertices;
    for (const Vec3& vertex : mesh.vertices) vertices.push_back(scale_ * vertex);
    return vertices;
  }

  double scale_;
  std::vector<Vec3> vertices_;
  std::vector<fcl::Triangle> triangles_;
  std::unique_ptr<Model> model_;
};

}  // namespace

/// FCL's hierarchy of oriented boxes and swept spheres, with the copy of the mesh into its model.
BuildImplementation fcl_build() {
  return {"fcl-obbrss", 1e-6, [](const Surface& surface) { return std::make_unique<FclBuild>(surface); }};
}

}  // namespace lmdbench::experiments
