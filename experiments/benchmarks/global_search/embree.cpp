// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>

#include <benchmarks/embree_mesh.h>
#include <benchmarks/global_search/implementation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::experiments {
namespace {

class EmbreeSearch : public GlobalSearch {
 public:
  explicit EmbreeSearch(const Scene& scene)
      : moving_(scene.moving), fixed_(scene.fixed.at(0).body), embree_(fixed_->surface().mesh) {}

  void run(const Pose& X_WM) override {
    const RigidTransform X(X_WM);
    const TriangleMesh& moving = moving_->surface().mesh;
    const TriangleMesh& fixed = fixed_->surface().mesh;
    minimum_ = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < moving.triangles.size(); ++t) {
      const Triangle triangle = X.triangle(moving.triangle(static_cast<std::int32_t>(t)));
      const Vec3 centre = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
      double radius = 0.0;
      for (const Vec3& corner : triangle) radius = std::max(radius, (corner - centre).norm());
      embree_.for_each_near(centre, minimum_ + radius, [&](std::int32_t other) {
        const double squared_distance = triangle_distance(triangle, fixed.triangle(other)).squared_distance;
        minimum_ = std::min(minimum_, std::sqrt(squared_distance));
        return minimum_ + radius;
      });
    }
  }
  double minimum_distance() const override { return minimum_; }
  const LmdSet* lmds() const override { return nullptr; }

 private:
  std::shared_ptr<const Body> moving_, fixed_;
  EmbreeMesh embree_;
  double minimum_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

/// The nearest pair by Embree, which has no queries between meshes: one point query per moving
/// triangle, round its centre, no farther than the best pair so far. Triangle distances are ours.
SearchImplementation embree_search() {
  return {"embree", Promise::NEAREST_PAIR, false,
          [](const Scene& scene) { return std::make_unique<EmbreeSearch>(scene); }};
}

}  // namespace lmdbench::experiments
