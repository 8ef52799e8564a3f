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

/// A prism over a level floor that goes down to the right behind a wall of some height.
inline TriangleMesh stepped(double wall) {
  const std::vector<std::array<double, 2>> outline{{-1, 0.5},    {0, 0.5}, {0, 0.5 - wall},
                                                   {0.5, -0.25}, {0.5, 1}, {-1, 1}};
  TriangleMesh mesh;
  for (const double y : {0.0, 1.0})
    for (const auto& [x, z] : outline) mesh.vertices.emplace_back(x, y, z);
  for (std::int32_t i = 0; i < 6; ++i) {
    const std::int32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, i + 6, j + 6});
    mesh.triangles.push_back({i, j + 6, j});
  }
  for (std::int32_t i = 0; i < 4; ++i) {
    mesh.triangles.push_back({4, i == 0 ? 5 : i - 1, i});
    mesh.triangles.push_back({10, i + 6, i == 0 ? 11 : i + 5});
  }
  return mesh;
}

}  // namespace lmdbench::testing
