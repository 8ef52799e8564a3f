// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/segment_distance.h>

#include <gtest/gtest.h>
#include <triangles/random_triangles.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lmdbench {
namespace {

using testing::random_point;

/// Distance by ternary search along one segment: the distance to the other one is convex.
double searched_distance(const Segment& a, const Segment& b) {
  const auto to_b = [&](double s) {
    const Vec3 p = a[0] + s * (a[1] - a[0]);
    const Vec3 d = b[1] - b[0];
    const double t = d.squaredNorm() > 0 ? std::clamp((p - b[0]).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    return (b[0] + t * d - p).norm();
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    (to_b(left) < to_b(right) ? high : low) = to_b(left) < to_b(right) ? right : left;
  }
  return std::min({to_b(0.0), to_b(1.0), to_b(0.5 * (low + high))});
}

TEST(PointSegment, ReportsTheRegion) {
  const Segment segment{Vec3(0, 0, 0), Vec3(2, 0, 0)};
  const auto before = point_segment_distance(Vec3(-1, 1, 0), segment);
  EXPECT_EQ(before.feature, SegmentFeature::V0);
  EXPECT_EQ(before.point, segment[0]);
  EXPECT_DOUBLE_EQ(before.squared_distance, 2.0);
  EXPECT_EQ(point_segment_distance(Vec3(0, 1, 0), segment).feature, SegmentFeature::V0);
  const auto inside = point_segment_distance(Vec3(0.5, 1, 0), segment);
  EXPECT_EQ(inside.feature, SegmentFeature::EDGE);
  EXPECT_EQ(inside.point, Vec3(0.5, 0, 0));
  EXPECT_EQ(point_segment_distance(Vec3(2, 0, 3), segment).feature, SegmentFeature::V1);
  EXPECT_EQ(point_segment_distance(Vec3(3, 0, 0), segment).squared_distance, 1.0);
}

TEST(PointSegment, OfEqualEndsIsAPoint) {
  const Segment point{Vec3(1, 2, 3), Vec3(1, 2, 3)};
  const auto result = point_segment_distance(Vec3(1, 2, 5), point);
  EXPECT_EQ(result.feature, SegmentFeature::V0);
  EXPECT_EQ(result.squared_distance, 4.0);
}

TEST(SegmentPair, ReportsTheRegion) {
  const Segment x{Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  const auto crossing = segment_distance(x, {Vec3(0.25, -1, 2), Vec3(0.25, 1, 2)});
  EXPECT_EQ(crossing.feature_a, SegmentFeature::EDGE);
  EXPECT_EQ(crossing.feature_b, SegmentFeature::EDGE);
  EXPECT_EQ(crossing.point_a, Vec3(0.25, 0, 0));
  EXPECT_EQ(crossing.squared_distance, 4.0);
  const auto end_over_middle = segment_distance(x, {Vec3(0.25, 1, 0), Vec3(0.25, 3, 0)});
  EXPECT_EQ(end_over_middle.feature_a, SegmentFeature::EDGE);
  EXPECT_EQ(end_over_middle.feature_b, SegmentFeature::V0);
  EXPECT_EQ(end_over_middle.point_b, Vec3(0.25, 1, 0));
  const auto ends = segment_distance(x, {Vec3(3, 4, 0), Vec3(2, 0, 0)});
  EXPECT_EQ(ends.feature_a, SegmentFeature::V1);
  EXPECT_EQ(ends.feature_b, SegmentFeature::V1);
  EXPECT_EQ(ends.squared_distance, 1.0);
}

TEST(SegmentPair, AnExactTieGoesToTheEnd) {
  // The common perpendicular meets b exactly at its end, where three candidates tie.
  const auto tie = segment_distance({Vec3(-1, 0, 0), Vec3(1, 0, 0)}, {Vec3(0, 0, 1), Vec3(0, 5, 1)});
  EXPECT_EQ(tie.feature_a, SegmentFeature::EDGE);
  EXPECT_EQ(tie.feature_b, SegmentFeature::V0);
}

TEST(SegmentPair, ParallelOverlapIsAnsweredByItsMiddle) {
  const Segment x{Vec3(0, 0, 0), Vec3(4, 0, 0)};
  for (const bool turned : {false, true}) {
    Segment other{Vec3(1, 2, 0), Vec3(9, 2, 0)};
    if (turned) std::swap(other[0], other[1]);
    const auto pair = segment_distance(x, other);
    EXPECT_EQ(pair.minimiser_dimension, 1);
    EXPECT_DOUBLE_EQ(pair.minimiser_measure, 3.0);
    EXPECT_EQ(pair.point_a, Vec3(2.5, 0, 0));
    EXPECT_EQ(pair.point_b, Vec3(2.5, 2, 0));
  }
  const auto apart = segment_distance(x, {Vec3(5, 1, 0), Vec3(9, 1, 0)});
  EXPECT_EQ(apart.minimiser_dimension, 0);
  EXPECT_EQ(apart.feature_a, SegmentFeature::V1);
  EXPECT_EQ(apart.feature_b, SegmentFeature::V0);
  const auto end_to_end = segment_distance(x, {Vec3(4, 1, 0), Vec3(9, 1, 0)});
  EXPECT_EQ(end_to_end.minimiser_dimension, 0);
  EXPECT_EQ(end_to_end.feature_a, SegmentFeature::V1);
  EXPECT_EQ(end_to_end.feature_b, SegmentFeature::V0);
}

TEST(SegmentPair, IsRightForEveryAngle) {
  // Segments cross at a gap; at the last angles the textbook determinant has no correct digit left.
  for (double angle = 1.0; angle > 1e-13; angle *= 0.1) {
    for (double gap = 1.0; gap > 1e-13; gap *= 0.1) {
      const Segment a{Vec3(-1, 0, 0), Vec3(1, 0, 0)};
      const Segment b{Vec3(-std::cos(angle), -std::sin(angle), gap),
                      Vec3(std::cos(angle), std::sin(angle), gap)};
      const auto pair = segment_distance(a, b);
      EXPECT_NEAR(std::sqrt(pair.squared_distance), gap, 4e-15) << "angle " << angle << " gap " << gap;
      EXPECT_EQ(pair.feature_a, SegmentFeature::EDGE);
      EXPECT_EQ(pair.feature_b, SegmentFeature::EDGE);
    }
  }
}

TEST(SegmentPair, AgreesWithASearchAndDoesNotDependOnOrder) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 3000; ++round) {
    Segment a{random_point(random), random_point(random)};
    Segment b{random_point(random), random_point(random)};
    if (round % 5 == 1) b[1] = b[0] + 0.7 * (a[1] - a[0]);
    if (round % 5 == 2) b[1] = b[0];
    if (round % 5 == 3) b[0] = a[1];
    const auto pair = segment_distance(a, b);
    ASSERT_NEAR(std::sqrt(pair.squared_distance), searched_distance(a, b), 1e-8) << "round " << round;
    ASSERT_EQ(pair.squared_distance, (pair.point_a - pair.point_b).squaredNorm());
    const auto turned = segment_distance({b[1], b[0]}, a);
    ASSERT_EQ(pair.point_a, turned.point_b);
    ASSERT_EQ(pair.point_b, turned.point_a);
    ASSERT_EQ(pair.feature_a, turned.feature_b);
    if (pair.feature_b == SegmentFeature::V0 && b[0] != b[1]) {
      ASSERT_EQ(turned.feature_a, SegmentFeature::V1);
      ASSERT_EQ(pair.point_b, b[0]);
    }
  }
}

}  // namespace
}  // namespace lmdbench
