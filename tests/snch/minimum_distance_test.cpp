// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

#include <lmdbench/lmd/body_distance.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

namespace lmdbench {
namespace {

double brute_force_distance(const TriangleMesh& moving, const TriangleMesh& fixed, const Pose& pose) {
  const RigidTransform transform(pose);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < moving.triangles.size(); ++a)
    for (std::size_t b = 0; b < fixed.triangles.size(); ++b)
      best =
          std::min(best, triangle_distance(transform.triangle(moving.triangle(static_cast<std::int32_t>(a))),
                                           fixed.triangle(static_cast<std::int32_t>(b)))
                             .squared_distance);
  return std::sqrt(best);
}

TEST(NearestPair, EqualsBruteForce) {
  std::mt19937_64 random(3);
  const Scene scene = testing::make_scene(make_blob(0.05, 0.01, 2), make_torus(0.05, 0.02, 16, 8), 1.0);
  const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
  for (int i = 0; i < 20; ++i) {
    Pose pose{0.2 * testing::uniform(random) * testing::random_direction(random),
              testing::random_rotation(random)};
    const NearestPair nearest = nearest_pair(moving, fixed, pose);
    EXPECT_EQ(nearest.distance, brute_force_distance(moving.surface().mesh, fixed.surface().mesh, pose));
  }
}

TEST(WithinDistance, IsWhetherTheNearestPairIs) {
  std::mt19937_64 random(4);
  const Scene scene = testing::make_scene(make_blob(0.05, 0.01, 2), make_torus(0.05, 0.02, 16, 8), 1.0);
  const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
  for (int i = 0; i < 40; ++i) {
    const Pose pose{0.2 * testing::uniform(random) * testing::random_direction(random),
                    testing::random_rotation(random)};
    const double nearest = nearest_pair(moving, fixed, pose).distance;
    const auto within = [&](double distance) { return within_distance(moving, fixed, pose, distance); };
    EXPECT_TRUE(within(nearest));
    EXPECT_TRUE(within(1.5 * nearest + 1e-3));
    if (nearest > 0.0) {
      EXPECT_FALSE(within(nearest * (1.0 - 1e-12)));
    }
  }
}

TEST(NearestPair, FindsNothingBeyondTheBound) {
  const Scene scene = testing::make_scene(make_sphere(0.5, 2), make_sphere(0.5, 2), 1.0);
  const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
  const Pose pose{Vec3(2.0, 0.0, 0.0)};
  const auto query = [&](double bound) { return nearest_pair(moving, fixed, pose, bound); };
  EXPECT_EQ(query(0.9).triangle_moving, -1);
  EXPECT_GE(query(1.2).triangle_moving, 0);
  EXPECT_NEAR(query(1.2).distance, 1.0, 0.03);
}

TEST(NearestPair, IsZeroInContact) {
  const Scene scene = testing::make_scene(make_sphere(0.5, 2), make_sphere(0.5, 2), 1.0);
  const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
  const Pose pose{Vec3(0.9, 0.01, 0.02)};
  EXPECT_EQ(nearest_pair(moving, fixed, pose).distance, 0.0);
}

}  // namespace
}  // namespace lmdbench
