// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace lmdbench {

MeshBounds MeshBounds::of(const Surface& surface) {
  const Eigen::AlignedBox3d box = bounding_box(surface.mesh);
  MeshBounds bounds;
  bounds.known = surface.mesh.planar_tolerance;
  if (box.isEmpty()) return bounds;
  bounds.centre = box.center();
  bounds.half_sides = 0.5 * box.sizes();
  bounds.radius = radius_about(surface.mesh, bounds.centre);
  // The largest coordinate is bounded by the sphere.
  bounds.known = std::max(bounds.known, LEAST_TOLERANCE * (bounds.centre.norm() + bounds.radius));
  LMDBENCH_ENSURES(std::isfinite(bounds.radius), "vertices that import did not check");
  return bounds;
}

Eigen::AlignedBox3d MeshBounds::placed(const RigidTransform& X_WF) const {
  const Vec3 middle = X_WF.point(centre);
  const Vec3 turned = X_WF.rotation.cwiseAbs() * half_sides;
  const Vec3 half =
      turned.cwiseMin(Vec3::Constant(radius)) + Vec3::Constant(PLACING_ROUNDING * coordinates(X_WF));
  return {middle - half, middle + half};
}

Pose relative_pose(const Pose& X_WF, const Pose& X_WM) {
  const Eigen::Quaterniond R_FW = X_WF.rotation.conjugate();
  return {R_FW * (X_WM.translation - X_WF.translation), (R_FW * X_WM.rotation).normalized()};
}

namespace {

struct OutlineSphere {
  Vec3 centre;
  double radius;
};

class OutlineSplitter {
 public:
  explicit OutlineSplitter(const TriangleMesh& mesh) : mesh_(mesh) {
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
      const Triangle corners = mesh.triangle(t);
      middles_.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    }
  }

  void split(std::span<std::int32_t> triangles, int parts, std::vector<OutlineSphere>& spheres) const {
    if (triangles.empty()) return;
    if (parts == 1 || triangles.size() == 1) return spheres.push_back(sphere_of(triangles));
    Eigen::AlignedBox3d box;
    for (const std::int32_t t : triangles) box.extend(middles_[static_cast<std::size_t>(t)]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const auto half = static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::nth_element(triangles.begin(), triangles.begin() + half, triangles.end(),
                     [&](std::int32_t a, std::int32_t b) {
                       const double of_a = middles_[static_cast<std::size_t>(a)][axis],
                                    of_b = middles_[static_cast<std::size_t>(b)][axis];
                       return of_a != of_b ? of_a < of_b : a < b;
                     });
    split(triangles.first(static_cast<std::size_t>(half)), parts / 2, spheres);
    split(triangles.subspan(static_cast<std::size_t>(half)), parts / 2, spheres);
  }

 private:
  OutlineSphere sphere_of(std::span<const std::int32_t> triangles) const {
    Eigen::AlignedBox3d box;
    for (const std::int32_t t : triangles)
      for (const Vec3& corner : mesh_.triangle(t)) box.extend(corner);
    OutlineSphere sphere{box.center(), 0.0};
    for (const std::int32_t t : triangles)
      for (const Vec3& corner : mesh_.triangle(t))
        sphere.radius = std::max(sphere.radius, (corner - sphere.centre).norm());
    return sphere;
  }

  const TriangleMesh& mesh_;
  std::vector<Vec3> middles_;
};

}  // namespace

MeshOutline MeshOutline::of(const Surface& surface) {
  std::vector<std::int32_t> triangles(surface.mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  std::vector<OutlineSphere> spheres;
  OutlineSplitter(surface.mesh).split(triangles, OUTLINE_SPHERES, spheres);
  MeshOutline outline;
  const auto count = static_cast<Eigen::Index>(spheres.size());
  for (Eigen::ArrayXd* values : {&outline.x, &outline.y, &outline.z, &outline.radius}) values->resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const OutlineSphere& sphere = spheres[static_cast<std::size_t>(i)];
    outline.x[i] = sphere.centre.x();
    outline.y[i] = sphere.centre.y();
    outline.z[i] = sphere.centre.z();
    outline.radius[i] = sphere.radius + PLACING_ROUNDING * (sphere.centre.norm() + sphere.radius);
  }
  outline.box = bounding_box(surface.mesh);
  return outline;
}

double outline_distance(const MeshOutline& moving, const MeshOutline& fixed, const RigidTransform& X_FM,
                        double enough) {
  double least = std::numeric_limits<double>::infinity();
  if (fixed.x.size() == 0) return least;
  for (Eigen::Index i = 0; i < moving.x.size(); ++i) {
    const Vec3 c = X_FM.point({moving.x[i], moving.y[i], moving.z[i]});
    const double rounding = 4.0 * PLACING_ROUNDING * (c.norm() + X_FM.translation.norm());
    const double taken = moving.radius[i] + rounding;
    if (fixed.box.exteriorDistance(c) - taken >= least) continue;
    const double distance =
        (((fixed.x - c.x()).square() + (fixed.y - c.y()).square() + (fixed.z - c.z()).square()).sqrt() -
         fixed.radius)
            .minCoeff();
    least = std::min(least, distance - taken);
    if (least <= enough) return least;
  }
  return least;
}

}  // namespace lmdbench
