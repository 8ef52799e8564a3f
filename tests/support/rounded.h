// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <support/scenes.h>

#include <cstdint>
#include <random>
#include <utility>

/// Meshes as in files of single precision.
namespace lmdbench::testing {

/// A rigid motion from a seed: any rotation, up to half a metre along each axis.
inline Pose pose_of_seed(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Pose pose;
  pose.rotation = random_rotation(random);
  for (int k = 0; k < 3; ++k) pose.translation[k] = uniform(random) - 0.5;
  return pose;
}

inline TriangleMesh placed(TriangleMesh mesh, const Pose& pose) {
  const RigidTransform X(pose);
  for (Vec3& p : mesh.vertices) p = X.point(p);
  return mesh;
}

inline TriangleMesh turned(TriangleMesh mesh, std::uint64_t seed) {
  return placed(std::move(mesh), pose_of_seed(seed));
}

inline TriangleMesh rounded_to_floats(TriangleMesh mesh) {
  return turned_to_floats(std::move(mesh), Eigen::Quaterniond::Identity());
}

}  // namespace lmdbench::testing
