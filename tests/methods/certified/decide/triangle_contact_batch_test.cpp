// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/certified/decide/triangle_contact_batch.h>

#include "geometry/every_family.h"
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lmdbench {
namespace {

struct Pairs {
  std::vector<Triangle> a, b;

  Pairs(const testing::TriangleFamily& family, std::uint64_t seed, std::size_t count) {
    testing::Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      const testing::TrianglePair pair = family.generate(random);
      a.push_back(pair.a);
      b.push_back(pair.b);
    }
  }
  double size(std::size_t i) const { return std::max(largest_coordinate(a[i]), largest_coordinate(b[i])); }
};

TEST(ClearCrossings, AreIntersectionsWithTheSegmentOfTheScalarKernel) {
  std::size_t crossing = 0, missed = 0;
  // With 1,003 pairs the last vectors are not full.
  for (const testing::TriangleFamily& family : testing::triangle_families()) {
    Pairs pairs(family, 305, 1003);
    std::vector<ClearCrossing> found(pairs.a.size());
    find_clear_crossings(pairs.a, pairs.b, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const TrianglePairDistance truth = triangle_distance(pairs.a[i], pairs.b[i]);
      if (found[i].length == 0.0) {
        missed += truth.intersecting;
        continue;
      }
      ++crossing;
      const double size = std::max(largest_coordinate(pairs.a[i]), largest_coordinate(pairs.b[i]));
      ASSERT_TRUE(truth.intersecting) << family.name << " pair " << i;
      ASSERT_TRUE(is_face(truth.feature_a) && is_face(truth.feature_b)) << family.name << " pair " << i;
      ASSERT_LE((found[i].middle - truth.point_a).norm(), 1e-12 * size) << family.name << " pair " << i;
      ASSERT_NEAR(found[i].length, truth.minimiser_measure, 1e-12 * size) << family.name << " pair " << i;
    }
  }
  EXPECT_GT(crossing, 500U);
  EXPECT_GT(missed, 100U) << "touching, coplanar and thin triangles are left to the scalar kernel";
}

TEST(ClearCrossings, OfSpecksBesideTheOtherAreLeftToTheScalarKernel) {
  const Triangle large{Vec3(-2.0, -1.0, 0.0), Vec3(2.0, -1.0, 0.1), Vec3(0.0, 3.0, -0.15)};
  for (const double size : {1e-2, 1e-3, 5e-6, 1e-6}) {
    const auto is_found = [&](const Triangle& a, const Triangle& b) {
      EXPECT_TRUE(triangle_distance(a, b).intersecting) << size;
      std::vector<ClearCrossing> found(1);
      find_clear_crossings(std::vector{a}, std::vector{b}, found);
      return found[0].length > 0.0;
    };
    const Triangle speck{size * Vec3(-0.9, 0.1, -1.0), size * Vec3(1.1, 0.2, -0.9),
                         size * Vec3(0.1, 0.3, 1.2)};
    EXPECT_EQ(is_found(large, speck), size > 1e-4) << size;
    // A needle through a speck.
    const Triangle needle{Vec3(0.0, 0.0, 0.5), Vec3(-size, 0.0, -0.5), Vec3(size, 0.3 * size, -0.5)};
    const Triangle flat{size * Vec3(-2.0, -1.0, 0.0), size * Vec3(2.0, -1.0, 0.1),
                        size * Vec3(0.0, 3.0, -0.1)};
    EXPECT_EQ(is_found(flat, needle), size > 1e-4) << size;
  }
}

TEST(ClearGaps, AreLowerBoundsAlongTheirAxes) {
  std::size_t gaps = 0, tight = 0, together = 0;
  for (const testing::TriangleFamily& family : testing::triangle_families()) {
    const Pairs pairs(family, 306, 1003);
    std::vector<ClearGap> found(pairs.a.size());
    find_clear_gaps(pairs.a, pairs.b, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double distance = std::sqrt(triangle_distance(pairs.a[i], pairs.b[i]).squared_distance);
      const double rounding = 1e-14 * pairs.size(i);
      together += distance == 0.0;
      ASSERT_LE(found[i].gap, distance + rounding) << family.name << " pair " << i;
      if (!(found[i].gap > rounding)) continue;
      ++gaps;
      tight += found[i].gap > 0.999 * distance;
      const Vec3& axis = found[i].axis;
      ASSERT_NEAR(axis.norm(), 1.0, 1e-12) << family.name << " pair " << i;
      const auto extent = [&](const Triangle& t) {
        return std::minmax({axis.dot(t[0]), axis.dot(t[1]), axis.dot(t[2])});
      };
      ASSERT_NEAR(extent(pairs.b[i]).first - extent(pairs.a[i]).second, found[i].gap, 10.0 * rounding)
          << family.name << " pair " << i << ": from a towards b";
    }
  }
  EXPECT_GT(gaps, 5000U);
  EXPECT_GT(tight, gaps / 3) << "the axis of faces and of crossed edges is that of the nearest points";
  EXPECT_GT(together, 500U) << "or the bound is never put to the test";
}

TEST(ClearGaps, AreFoundWhereverTrianglesInGeneralPositionAreApart) {
  const Pairs pairs(testing::triangle_families()[0], 307, 4000);
  std::vector<ClearGap> found(pairs.a.size());
  find_clear_gaps(pairs.a, pairs.b, found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double distance = std::sqrt(triangle_distance(pairs.a[i], pairs.b[i]).squared_distance);
    EXPECT_EQ(found[i].gap > 0.0, distance > 0.0) << i;
  }
}

TEST(ClearGaps, AreTheSameBitsOnEveryProcessor) {
  const Pairs pairs(testing::triangle_families()[0], 308, 1003);
  std::vector<ClearGap> best(pairs.a.size()), gaps(pairs.a.size());
  std::vector<ClearCrossing> best_crossings(pairs.a.size()), crossings(pairs.a.size());
  find_clear_gaps(pairs.a, pairs.b, best);
  find_clear_crossings(pairs.a, pairs.b, best_crossings);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    find_clear_gaps(pairs.a, pairs.b, gaps);
    find_clear_crossings(pairs.a, pairs.b, crossings);
    for (std::size_t i = 0; i < best.size(); ++i) {
      ASSERT_EQ(best[i].gap, gaps[i].gap) << hwy::TargetName(target) << " pair " << i;
      ASSERT_EQ(best[i].axis, gaps[i].axis) << hwy::TargetName(target) << " pair " << i;
      ASSERT_EQ(best_crossings[i].length, crossings[i].length) << hwy::TargetName(target) << " pair " << i;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace lmdbench
