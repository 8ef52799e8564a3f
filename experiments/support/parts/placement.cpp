// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/shape/flatten.h>

#include <support/parts/placement.h>

#include <utility>

namespace lmdbench::parts {

Pose random_placement(double reach, experiments::Random& random) {
  Pose X;
  X.rotation = random.rotation();
  for (double& x : X.translation) x = random.uniform(-reach, reach);
  return X;
}

std::shared_ptr<const Body> placed_body(const char* name, TriangleMesh mesh, const Pose& X_FD,
                                        bool in_floats) {
  const RigidTransform X(X_FD);
  for (Vec3& p : mesh.vertices) p = X.point(p);
  if (in_floats) {
    mesh = turned_to_floats(std::move(mesh), Eigen::Quaterniond::Identity());
    flatten(mesh);
  }
  return std::make_shared<const Body>(name, build_surface(std::move(mesh)));
}

std::shared_ptr<const Body> scaled_body(const char* name, TriangleMesh mesh, double size,
                                        const Vec3& offset) {
  for (Vec3& p : mesh.vertices) p = size * p + offset;
  mesh.planar_tolerance *= size;
  return std::make_shared<const Body>(name, build_surface(std::move(mesh)));
}

std::vector<Pose> poses_of(std::size_t count, bool slides, const Vec3& step, const Eigen::Quaterniond& turn,
                           const std::function<Pose()>& unrelated) {
  std::vector<Pose> poses;
  while (poses.size() < count) {
    if (!slides || poses.empty()) {
      poses.push_back(unrelated());
      continue;
    }
    Pose next = poses.back();
    next.translation += step;
    // No turn keeps the exact bits.
    if (turn.vec() != Vec3::Zero()) next.rotation = (turn * next.rotation).normalized();
    poses.push_back(next);
  }
  return poses;
}

}  // namespace lmdbench::parts
