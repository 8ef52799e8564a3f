// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/build/polar_cap.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>

namespace lmdbench {
namespace {

/// A vertex at the origin with `count` triangles; its neighbours are `rise(turn)` above it.
template <typename Rise>
Surface hub(std::int32_t count, Rise&& rise) {
  TriangleMesh mesh;
  mesh.vertices.push_back(Vec3::Zero());
  for (std::int32_t i = 0; i < count; ++i) {
    const double turn = 2.0 * M_PI * i / count;
    mesh.vertices.push_back(Vec3(std::cos(turn), std::sin(turn), rise(turn)));
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return build_surface(mesh);
}

constexpr FeatureId HUB{FeatureKind::VERTEX, 0};

TEST(PolarCapOfAHub, IsThatOfTheRoundCone) {
  for (const double slope : {0.01, 0.3, 1.0, 5.0}) {
    const double half_angle = std::atan(slope);  // of the cone of directions round z
    for (const std::int32_t count : {16, 128, 129, 500, 4000}) {
      const Surface peak = hub(count, [&](double) { return -slope; });
      const auto cap = polar_cap(peak, HUB);
      ASSERT_TRUE(cap.has_value()) << slope << ", " << count;
      ASSERT_FALSE(cap->is_all_directions());
      EXPECT_NEAR(cap->axis.z(), 1.0, 2e-3);
      const double width = std::atan2(cap->sine, cap->cosine);
      const double off = std::acos(std::min(1.0, cap->axis.z()));
      EXPECT_GE(width - off, half_angle) << "holds the whole cone; " << slope << ", " << count;
      // A circumscribed polygon of 16 corners is that much wider; one of 128 a sixty-fourth of it.
      EXPECT_LE(std::tan(width), std::tan(half_angle) / std::cos(M_PI / 16) * 1.01 + 1e-5) << count;
    }
  }
}

TEST(PolarCapOfAHub, PitsAndSaddlesHaveNone) {
  EXPECT_FALSE(polar_cap(hub(4000, [](double) { return 0.3; }), HUB).has_value());
  EXPECT_FALSE(polar_cap(hub(4000, [](double turn) { return 0.1 * std::cos(2 * turn); }), HUB).has_value());
  EXPECT_FALSE(polar_cap(hub(4000, [](double turn) { return std::cos(7 * turn) - 0.5; }), HUB).has_value());
}

TEST(PolarCapOfAHub, AFlatOneIsItsNormal) {
  const auto cap = polar_cap(hub(4000, [](double) { return 0.0; }), HUB);
  ASSERT_TRUE(cap.has_value());
  EXPECT_NEAR(cap->axis.z(), 1.0, 1e-9);
  EXPECT_LT(cap->sine, 1e-4);
}

TEST(PolarCapOfAHub, TakesTimeLinearInItsTriangles) {
  const auto seconds = [](std::int32_t count) {
    const Surface peak = hub(count, [](double) { return -0.5; });
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(polar_cap(peak, HUB).has_value());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  seconds(1000);
  // A cubic method takes hours for 20,000; a busy machine may take ten times the usual 10 ms.
  EXPECT_LT(seconds(20000), 2.0);
}

}  // namespace
}  // namespace lmdbench
