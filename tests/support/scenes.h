// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/surface.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>

/// Scenes and poses that several tests use.
namespace lmdbench::testing {

inline std::shared_ptr<const Body> make_body(std::string name, TriangleMesh mesh) {
  return std::make_shared<const Body>(std::move(name), build_surface(std::move(mesh)));
}

inline Scene make_scene(TriangleMesh moving, TriangleMesh fixed, double cutoff) {
  return {make_body("moving", std::move(moving)), {make_body("fixed", std::move(fixed))}, cutoff};
}

/// A translation.
inline Pose moved(double x, double y, double z) {
  return {Vec3(x, y, z)};
}

/// Uniform in [0, 1), the same on every standard library.
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1.0p-53;
}

inline Vec3 random_direction(std::mt19937_64& random) {
  const double z = 2.0 * uniform(random) - 1.0, angle = 2.0 * std::numbers::pi * uniform(random);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Uniform rotation (Shoemake 1992).
inline Eigen::Quaterniond random_rotation(std::mt19937_64& random) {
  const double u = uniform(random), a = 2.0 * std::numbers::pi * uniform(random);
  const double b = 2.0 * std::numbers::pi * uniform(random);
  return {std::sqrt(1.0 - u) * std::sin(a), std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b),
          std::sqrt(u) * std::cos(b)};
}

/// A pose of random orientation at distance `gap` from the first fixed body, reached from outside.
inline Pose grazing_pose(const Scene& scene, double gap, std::mt19937_64& random) {
  const Body& moving = *scene.moving;
  const Body& fixed = *scene.fixed[0];
  Pose pose;
  pose.rotation = random_rotation(random);
  const Vec3 outward = -random_direction(random);
  const double displacement = first_approach(moving, fixed, pose, outward, gap, 1e-9).displacement;
  if (!std::isfinite(displacement)) return grazing_pose(scene, gap, random);  // A miss.
  pose.translation = displacement * outward;
  return pose;
}

}  // namespace lmdbench::testing
