// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

constexpr double PI = std::numbers::pi;

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random);
  const double y = normal(random);
  return Vec3(x, y, normal(random)).normalized();
}

Vec3 direction_within(std::mt19937_64& random, const Vec3& axis, double half_angle) {
  std::uniform_real_distribution<double> angle(0.0, half_angle);
  const Vec3 across = axis.cross(random_direction(random)).normalized();
  return (Eigen::AngleAxisd(angle(random), across) * axis).normalized();
}

TEST(Cone, DefaultIsAllDirections) {
  const Cone cone;
  EXPECT_TRUE(cone.is_all_directions());
  EXPECT_DOUBLE_EQ(cone.half_angle(), PI);
  EXPECT_TRUE(cone.contains(-Vec3::UnitX()));
}

TEST(Cone, OfOneDirectionHasNoWidth) {
  const Cone cone = cone_of_directions(std::array{Vec3(Vec3::UnitZ())});
  EXPECT_TRUE(cone.contains(Vec3::UnitZ()));
  EXPECT_LT(cone.half_angle(), 1e-14);
}

TEST(Cone, OfTwoDirectionsIsTheirBisector) {
  const std::array<Vec3, 2> directions{Vec3::UnitX(), Vec3::UnitY()};
  const Cone cone = cone_of_directions(directions);
  EXPECT_NEAR(cone.half_angle(), PI / 4, 1e-12);
  EXPECT_NEAR((cone.axis - Vec3(1, 1, 0).normalized()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(cone.cosine * cone.cosine + cone.sine * cone.sine, 1.0, 1e-15);
}

TEST(Cone, OfTheCornerOfACubeIsTheSmallest) {
  const std::array<Vec3, 3> directions{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  EXPECT_NEAR(cone_of_directions(directions).half_angle(), std::acos(1.0 / std::sqrt(3.0)), 1e-12);
}

TEST(Cone, IgnoresZeroVectorsAndOfNothingIsAllDirections) {
  const std::array<Vec3, 2> some{Vec3::Zero(), Vec3::UnitY()};
  EXPECT_TRUE(cone_of_directions(some).contains(Vec3::UnitY()));
  EXPECT_LT(cone_of_directions(some).half_angle(), 1e-14);
  const std::array<Vec3, 1> none{Vec3::Zero()};
  EXPECT_TRUE(cone_of_directions(none).is_all_directions());
  EXPECT_TRUE(cone_of_directions({}).is_all_directions());
}

TEST(Cone, OppositeDirectionsAreAllDirections) {
  const std::array<Vec3, 2> directions{Vec3::UnitX(), -Vec3::UnitX()};
  EXPECT_TRUE(cone_of_directions(directions).is_all_directions());
}

TEST(Cone, ContainsEveryDirectionItWasMadeOf) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> width(0.0, PI);
  for (int round = 0; round < 500; ++round) {
    const Vec3 axis = random_direction(random);
    const double half_angle = width(random);
    std::vector<Vec3> directions;
    for (int i = 0; i < 1 + round % 40; ++i) directions.push_back(direction_within(random, axis, half_angle));
    const Cone cone = cone_of_directions(directions);
    for (const Vec3& direction : directions) ASSERT_TRUE(cone.contains(direction)) << "round " << round;
    // The directions come from a cone, so the smallest cone may not be wider than that one.
    if (half_angle < 0.49 * PI) {
      ASSERT_LE(cone.half_angle(), half_angle + 1e-9) << "round " << round;
    }
  }
}

TEST(Cone, ConvexConeOfAWideSetIsAllDirections) {
  // No half space contains all corners of a tetrahedron.
  const std::array<Vec3, 4> directions{Vec3(1, 1, 1).normalized(), Vec3(1, -1, -1).normalized(),
                                       Vec3(-1, 1, -1).normalized(), Vec3(-1, -1, 1).normalized()};
  EXPECT_TRUE(convex_cone_of_directions(directions).is_all_directions());
  const std::array<Vec3, 2> narrow{Vec3::UnitX(), Vec3::UnitY()};
  EXPECT_FALSE(convex_cone_of_directions(narrow).is_all_directions());
}

TEST(Cone, MergeContainsBothAndIsNoWiderThanNeeded) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> width(0.0, 0.5 * PI);
  for (int round = 0; round < 500; ++round) {
    const Vec3 axis_a = random_direction(random);
    const Vec3 axis_b = round % 10 == 0 ? axis_a : round % 10 == 1 ? Vec3(-axis_a) : random_direction(random);
    const double phi_a = width(random);
    const double phi_b = width(random);
    const Cone a{axis_a, std::cos(phi_a), std::sin(phi_a)};
    const Cone b{axis_b, std::cos(phi_b), std::sin(phi_b)};
    const Cone merged = merge_cones(a, b);
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(merged.contains(direction_within(random, axis_a, phi_a))) << "round " << round;
      ASSERT_TRUE(merged.contains(direction_within(random, axis_b, phi_b))) << "round " << round;
    }
    const double between = std::acos(std::clamp(axis_a.dot(axis_b), -1.0, 1.0));
    const double needed = std::max({phi_a, phi_b, 0.5 * (between + phi_a + phi_b)});
    ASSERT_LE(merged.half_angle(), std::min(PI, needed) + 1e-7) << "round " << round;
  }
  EXPECT_TRUE(merge_cones(Cone{}, cone_of_directions(std::array{Vec3(Vec3::UnitX())})).is_all_directions());
}

}  // namespace
}  // namespace lmdbench
