// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <benchmarks/cgal_tree.h>

#include <cmath>
#include <vector>

namespace lmdbench::experiments {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Vec3& point) {
  return {point.x(), point.y(), point.z()};
}

Triangles to_cgal(const TriangleMesh& mesh) {
  Triangles triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle corners = mesh.triangle(static_cast<std::int32_t>(t));
    triangles.emplace_back(to_cgal(corners[0]), to_cgal(corners[1]), to_cgal(corners[2]));
  }
  return triangles;
}

}  // namespace

class CgalTree::Implementation {
 public:
  explicit Implementation(const TriangleMesh& mesh)
      : triangles_(to_cgal(mesh)), tree_(triangles_.begin(), triangles_.end()) {
    tree_.build();
  }
  double distance(const Vec3& point) const { return std::sqrt(tree_.squared_distance(to_cgal(point))); }
  double distance(const Vec3& point, double limit) const {
    // A hint at the limit: the tree searches no farther than its hint.
    const Kernel::Point_3 hint = to_cgal(point + Vec3(limit, 0.0, 0.0));
    return std::sqrt(CGAL::squared_distance(to_cgal(point), tree_.closest_point(to_cgal(point), hint)));
  }

 private:
  Triangles triangles_;
  Tree tree_;
};

CgalTree::CgalTree(const TriangleMesh& mesh) : implementation_(std::make_unique<Implementation>(mesh)) {}
CgalTree::~CgalTree() = default;
CgalTree::CgalTree(CgalTree&& other) noexcept = default;
CgalTree& CgalTree::operator=(CgalTree&& other) noexcept = default;

double CgalTree::distance(const Vec3& point) const {
  return implementation_->distance(point);
}
double CgalTree::distance(const Vec3& point, double limit) const {
  return implementation_->distance(point, limit);
}

}  // namespace lmdbench::experiments
