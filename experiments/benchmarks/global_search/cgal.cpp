// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/cgal_tree.h>
#include <benchmarks/global_search/implementation.h>

#include <limits>

namespace lmdbench::experiments {
namespace {

class CgalVertices : public GlobalSearch {
 public:
  explicit CgalVertices(const Scene& scene)
      : moving_(scene.moving),
        fixed_(scene.fixed.at(0).body),
        moving_tree_(moving_->surface().mesh),
        fixed_tree_(fixed_->surface().mesh) {}

  void run(const Pose& X_WM) override {
    const RigidTransform X(X_WM), X_MW(X_WM.inverse());
    const std::vector<Vec3>& vertices = moving_->surface().mesh.vertices;
    minimum_ = fixed_tree_.distance(X.point(vertices.front()));
    for (const Vec3& vertex : vertices) minimum_ = fixed_tree_.distance(X.point(vertex), minimum_);
    for (const Vec3& vertex : fixed_->surface().mesh.vertices)
      minimum_ = moving_tree_.distance(X_MW.point(vertex), minimum_);
  }
  double minimum_distance() const override { return minimum_; }
  const LmdSet* lmds() const override { return nullptr; }

 private:
  std::shared_ptr<const Body> moving_, fixed_;
  CgalTree moving_tree_, fixed_tree_;
  double minimum_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

/// CGAL's tree answers points, not meshes: this is the least distance of any vertex of one mesh to
/// the other mesh. It is an upper bound of the minimum distance, exact unless the nearest pair is
/// edge-edge. Each query searches no farther than the best so far.
SearchImplementation cgal_vertex_search() {
  return {"cgal-vertices", Promise::APPROXIMATION, false,
          [](const Scene& scene) { return std::make_unique<CgalVertices>(scene); }};
}

}  // namespace lmdbench::experiments
