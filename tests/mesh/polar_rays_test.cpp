// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/polar_cone.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using IntegerVector = std::array<std::int64_t, 3>;

IntegerVector exact_cross(const IntegerVector& a, const IntegerVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const IntegerVector& a, const IntegerVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Exact: a polar cone other than {0} has an extreme ray or a line along some cross product of two directions,
// unless all directions are parallel, when it is at least a plane.
bool is_polar_exactly_empty(const std::vector<IntegerVector>& directions) {
  bool all_parallel = true;
  for (const auto& a : directions) {
    for (const auto& b : directions) {
      const IntegerVector c = exact_cross(a, b);
      if (c == IntegerVector{0, 0, 0}) continue;
      all_parallel = false;
      for (const std::int64_t sign : {1, -1})
        if (std::all_of(directions.begin(), directions.end(),
                        [&](const IntegerVector& e) { return sign * dot(c, e) <= 0; }))
          return false;
    }
  }
  return !all_parallel;
}

class IntegerPolarTest : public ::testing::TestWithParam<int> {};

// Small integers make parallel, opposite, coplanar and straight sets frequent, and every violation far larger
// than the tolerance, so that exact emptiness and emptiness of the widened set agree.
TEST_P(IntegerPolarTest, EmptinessIsExact) {
  const int range = GetParam();
  std::mt19937 random(static_cast<unsigned>(range));
  std::uniform_int_distribution<int> coordinate(-range, range), count(1, 8);
  int empty = 0, full = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::vector<IntegerVector> integers;
    std::vector<Vec3> directions;
    for (int i = count(random); i > 0; --i) {
      const IntegerVector e{coordinate(random), coordinate(random), coordinate(random)};
      if (e == IntegerVector{0, 0, 0}) continue;
      integers.push_back(e);
      directions.push_back(Vec3(e[0], e[1], e[2]).normalized());
    }
    if (directions.empty()) continue;
    const bool exactly_empty = is_polar_exactly_empty(integers);
    ++(exactly_empty ? empty : full);
    const auto rays = polar_rays(directions, Vec3::Zero(), 1e-8);
    ASSERT_EQ(rays.empty(), exactly_empty) << "trial " << trial;
    ASSERT_EQ(polar_rays(directions, Vec3::Zero(), 1e-8, true).empty(), exactly_empty);
    for (const Vec3& ray : rays)
      for (const Vec3& e : directions) ASSERT_LE(ray.dot(e), 2e-8);
  }
  EXPECT_GT(empty, 300);
  EXPECT_GT(full, 300);
}

INSTANTIATE_TEST_SUITE_P(Ranges, IntegerPolarTest, ::testing::Values(1, 2, 7, 20));

// The widest gap between a direction of the cone and the conical hull of the rays, as the largest dot product
// with a separating direction, is what coverage means; a dense set of hull directions is easier to get right:
// the cone's directions must not lie outside every half-space that holds all rays.
TEST(PolarRaysTest, HullCoversTheWholeConeEvenWhenItHoldsALine) {
  struct Case {
    std::vector<Vec3> directions;
    const char* name;
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const std::vector<Case> cases{{{}, "everything"},
                                {{x}, "half-space"},
                                {{x, -x}, "plane"},
                                {{x, y}, "wedge"},
                                {{x, y, (x + y).normalized()}, "wedge, one direction needless"},
                                {{x, y, z}, "octant"},
                                {{x, -x, y}, "half-plane"},
                                {{x, -x, y, -y}, "line"},
                                {{x, (x + 1e-3 * y).normalized()}, "nearly a half-space"},
                                {{x, y, (x + y + 1e-6 * z).normalized()}, "nearly a wedge"}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const Case& c : cases) {
    const auto rays = polar_rays(c.directions, Vec3::Zero(), 1e-8);
    ASSERT_FALSE(rays.empty()) << c.name;
    // Directions of the polar's own polar: positive combinations of the given ones, and nothing
    // else, may have all rays on their negative side. A direction s that separates a ray-free
    // part of the cone would be another.
    for (int i = 0; i < 20000; ++i) {
      const Vec3 s = Vec3(normal(random), normal(random), normal(random)).normalized();
      const bool all_rays_behind =
          std::all_of(rays.begin(), rays.end(), [&](const Vec3& r) { return r.dot(s) < -1e-5; });
      if (!all_rays_behind) continue;
      // Then every direction n of the cone must be behind s too.
      for (int k = 0; k < 50; ++k) {
        const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
        const bool in_cone = std::all_of(c.directions.begin(), c.directions.end(),
                                         [&](const Vec3& e) { return n.dot(e) <= 0; });
        if (in_cone) {
          ASSERT_LT(n.dot(s), 0.0) << c.name;
        }
      }
    }
  }
}

TEST(PolarRaysTest, HalfPlaneHasItsMiddle) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  const auto rays = polar_rays(std::vector<Vec3>{x, -x, y}, Vec3::Zero(), 1e-8);
  for (const Vec3& wanted : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, -1, 0)})
    EXPECT_TRUE(std::any_of(rays.begin(), rays.end(), [&](const Vec3& r) {
      return (r - wanted).norm() < 1e-7;
    })) << wanted.transpose();
}

TEST(PolarRaysTest, OuterSideDropsOneHalfOfALine) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  const auto rays = polar_rays(std::vector<Vec3>{x, -x, y, -y}, Vec3::UnitZ(), 1e-8);
  ASSERT_FALSE(rays.empty());
  for (const Vec3& ray : rays) EXPECT_LT((ray - Vec3::UnitZ()).norm(), 1e-7);
}

TEST(PolarRaysTest, KeepsWhatIsEmptyByLessThanTheTolerance) {
  // Four directions of a saddle whose two halves bend apart by `bend`.
  const auto saddle = [](double bend) {
    return std::vector<Vec3>{Vec3(1, 0, bend).normalized(), Vec3(-1, 0, bend).normalized(),
                             Vec3(0, 1, -bend).normalized(), Vec3(0, -1, -bend).normalized()};
  };
  EXPECT_TRUE(polar_rays(saddle(1e-6), Vec3::UnitZ(), 1e-8).empty());
  EXPECT_FALSE(polar_rays(saddle(1e-9), Vec3::UnitZ(), 1e-8).empty());
}

// Directions of a vertex of high degree: the polar of a circular cone is a circular cone.
std::vector<Vec3> fan(std::size_t count, double half_angle, const Vec3& axis,
                      std::mt19937* shuffle = nullptr) {
  const Vec3 u = axis.unitOrthogonal(), w = axis.cross(u);
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    directions.push_back(std::cos(half_angle) * axis +
                         std::sin(half_angle) * (std::cos(turn) * u + std::sin(turn) * w));
  }
  if (shuffle != nullptr) std::shuffle(directions.begin(), directions.end(), *shuffle);
  return directions;
}

/// Whether n is a combination of the rays with no negative share, to rounding: n is in the convex spherical polygon
/// of the rays, which here are in no half-space's boundary. By the separating directions that pairs of rays give.
bool is_covered(const std::vector<Vec3>& rays, const Vec3& n) {
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t j = 0; j < rays.size(); ++j) {
      const Vec3 side = rays[i].cross(rays[j]);
      if (side.norm() < 1e-9 || side.normalized().dot(n) < 1e-12) continue;
      if (std::all_of(rays.begin(), rays.end(), [&](const Vec3& r) { return r.dot(side) <= 1e-12; }))
        return false;
    }
  return true;
}

TEST(PolarRaysOfMany, CoverTheConeOfARoundFan) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  for (const double half_angle : {0.6, 1.2, 1.5}) {
    const double polar = M_PI / 2 - half_angle;  // of the cone of directions n with n . e <= 0, round -axis
    for (const std::size_t count : {129u, 300u, 5000u}) {
      const auto directions = fan(count, half_angle, axis, &random);
      const auto rays = polar_rays(directions, Vec3::Zero(), 1e-8);
      ASSERT_GE(rays.size(), 30u);
      ASSERT_LE(rays.size(), 400u);
      const Vec3 u = axis.unitOrthogonal(), w = axis.cross(u);
      for (int trial = 0; trial < 30; ++trial) {
        const double turn = 2.0 * M_PI * unit(random);
        const Vec3 n = -std::cos(polar) * axis +
                       std::sin(polar) * (std::cos(turn) * u + std::sin(turn) * w);  // on its rim
        EXPECT_TRUE(is_covered(rays, n)) << count << " directions of " << half_angle;
      }
      for (const Vec3& ray : rays)  // and not much more
        EXPECT_LT(std::acos(std::clamp(-ray.dot(axis), -1.0, 1.0)), polar * 1.02 + 1e-6);
    }
  }
}

TEST(PolarRaysOfMany, FlatFansHaveTheirNormal) {
  std::mt19937 random(8);
  const auto directions = fan(4000, M_PI / 2, Vec3::UnitZ(), &random);
  const auto rays = polar_rays(directions, Vec3::UnitZ(), 1e-8);
  ASSERT_FALSE(rays.empty());
  for (const Vec3& ray : rays) EXPECT_LT((ray - Vec3::UnitZ()).norm(), 1e-7);
}

TEST(PolarRaysOfMany, EmptinessIsThatOfAllDirections) {
  std::mt19937 random(9);
  // A saddle, a pit seen from its outer side, and a fan with one direction that spoils it by more, or less, than the
  // tolerance.
  std::vector<Vec3> saddle;
  for (int i = 0; i < 3000; ++i) {
    const double turn = 2.0 * M_PI * i / 3000;
    saddle.push_back(Vec3(std::cos(turn), std::sin(turn), 1e-4 * std::cos(2 * turn)).normalized());
  }
  std::shuffle(saddle.begin(), saddle.end(), random);
  for (const bool first_only : {false, true}) {
    EXPECT_TRUE(polar_rays(saddle, Vec3::UnitZ(), 1e-8, first_only).empty());
    EXPECT_TRUE(polar_rays(fan(3000, 1.0, Vec3::UnitZ(), &random), Vec3::UnitZ(), 1e-8, first_only).empty());
    for (const double excess : {1e-6, 1e-10}) {
      // The polar of the flat fan is the line along z; the spoiler leaves its lower half, or by less than the tolerance
      // both.
      auto spoiled = fan(3000, M_PI / 2, Vec3::UnitZ(), &random);
      spoiled.insert(spoiled.begin() + 1234, Vec3(1, 0, excess).normalized());
      EXPECT_EQ(polar_rays(spoiled, Vec3::UnitZ(), 1e-8, first_only).empty(), excess > 1e-8) << excess;
    }
  }
}

TEST(PolarRaysOfMany, RandomSetsAreEmptyWhereAllCrossingsSayIt) {
  std::mt19937 random(10);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> width(0.3, 3.0);
  int empty = 0, full = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Vec3> directions;
    const double spread = width(random);
    for (int i = 0; i < 150; ++i)
      directions.push_back(
          (Vec3::UnitX() + spread * Vec3(0.3 * normal(random), normal(random), normal(random))).normalized());
    // All crossings, whatever the number of directions: the polar is empty when every crossing is outside.
    bool none = true;
    for (std::size_t i = 0; none && i < directions.size(); ++i)
      for (std::size_t j = 0; none && j < directions.size(); ++j) {
        if (i == j) continue;
        const Vec3 n = directions[i].cross(directions[j]).normalized();
        none = !std::all_of(directions.begin(), directions.end(),
                            [&](const Vec3& e) { return n.dot(e) <= 1e-9; });
      }
    ++(none ? empty : full);
    EXPECT_EQ(polar_rays(directions, Vec3::Zero(), 1e-8).empty(), none) << "trial " << trial;
    EXPECT_EQ(polar_rays(directions, Vec3::Zero(), 1e-8, true).empty(), none) << "trial " << trial;
  }
  EXPECT_GT(empty, 10);
  EXPECT_GT(full, 10);
}

}  // namespace
}  // namespace lmdbench
