// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/minimum_distance.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

TEST(NearestPoint, EqualsBruteForceAndKeepsToItsBound) {
  const auto body = testing::make_body("torus", make_torus(0.05, 0.02, 16, 8));
  const Surface& surface = body->surface();
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = 0.12 * testing::uniform(random) * testing::random_direction(random);
    double best = std::numeric_limits<double>::infinity();
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface.mesh.triangles.size()); ++t)
      best = std::min(best, std::sqrt(point_triangle_distance(p, surface.mesh.triangle(t)).squared_distance));
    const NearestPoint nearest = nearest_point(surface, body->prepared<Hierarchy>(), p);
    EXPECT_EQ(nearest.distance, best);
    EXPECT_NEAR((nearest.place.point - p).norm(), best, 1e-15);
    EXPECT_NEAR(
        std::sqrt(point_triangle_distance(p, surface.mesh.triangle(nearest.triangle)).squared_distance), best,
        0.0);
    EXPECT_EQ(nearest_point(surface, body->prepared<Hierarchy>(), p, best).distance, best);
    EXPECT_EQ(nearest_point(surface, body->prepared<Hierarchy>(), p, best * (1.0 - 1e-12)).triangle, -1);
  }
}

}  // namespace
}  // namespace lmdbench
