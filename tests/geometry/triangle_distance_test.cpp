// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

constexpr std::array<std::array<int, 3>, 6> PERMUTATIONS{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

Triangle permuted(const Triangle& triangle, const std::array<int, 3>& order) {
  return {triangle[order[0]], triangle[order[1]], triangle[order[2]]};
}

/// Maps a feature of the permuted triangle to that of `triangle`.
TriangleFeature unpermuted(TriangleFeature feature, const std::array<int, 3>& order) {
  if (is_vertex(feature)) return vertex_feature(order[local_index(feature)]);
  if (is_face(feature)) return feature;
  const int opposite = order[(local_index(feature) + 2) % 3];
  return edge_feature((opposite + 1) % 3);
}

const Triangle FLOOR{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

/// FLOOR and a triangle with a known answer, checked under all 72 orders of corners and arguments.
void expect_known(const char* name, const Triangle& other, double distance, const Vec3& on_floor,
                  const Vec3& on_other, TriangleFeature of_floor, TriangleFeature of_other, int dimension = 0,
                  double measure = 0.0, bool intersecting = false) {
  SCOPED_TRACE(name);
  for (const auto& order_a : PERMUTATIONS) {
    for (const auto& order_b : PERMUTATIONS) {
      for (const bool swap : {false, true}) {
        const Triangle a = permuted(FLOOR, order_a);
        const Triangle b = permuted(other, order_b);
        const TrianglePairDistance pair = swap ? triangle_distance(b, a) : triangle_distance(a, b);
        const Vec3& point_a = swap ? pair.point_b : pair.point_a;
        const Vec3& point_b = swap ? pair.point_a : pair.point_b;
        EXPECT_NEAR(std::sqrt(pair.squared_distance), distance, 1e-14);
        EXPECT_NEAR((point_a - on_floor).norm(), 0.0, 1e-14) << point_a.transpose();
        EXPECT_NEAR((point_b - on_other).norm(), 0.0, 1e-14) << point_b.transpose();
        EXPECT_EQ(unpermuted(swap ? pair.feature_b : pair.feature_a, order_a), of_floor);
        EXPECT_EQ(unpermuted(swap ? pair.feature_a : pair.feature_b, order_b), of_other);
        EXPECT_EQ(pair.minimiser_dimension, dimension);
        EXPECT_NEAR(pair.minimiser_measure, measure, 1e-14);
        EXPECT_EQ(pair.intersecting, intersecting);
      }
    }
  }
}

TEST(TriangleDistance, OfPairsWhoseAnswerIsKnown) {
  using enum TriangleFeature;
  expect_known("corner to corner", {Vec3(-3, 0, 4), Vec3(-9, 0, 5), Vec3(-9, 1, 9)}, 5.0, {0, 0, 0},
               {-3, 0, 4}, V0, V0);
  expect_known("corner to edge", {Vec3(2, -3, 4), Vec3(1, -9, 5), Vec3(3, -9, 9)}, 5.0, {2, 0, 0}, {2, -3, 4},
               E0, V0);
  expect_known("corner to face", {Vec3(1, 1, 3), Vec3(2, 1, 4), Vec3(1, 2, 5)}, 3.0, {1, 1, 0}, {1, 1, 3},
               FACE, V0);
  expect_known("edge to edge", {Vec3(2, -1, -1), Vec3(2, -1, 1), Vec3(3, -9, 0)}, 1.0, {2, 0, 0}, {2, -1, 0},
               E0, E0);
  // A tie goes to the lowest dimension.
  expect_known("corner exactly over the edge", {Vec3(2, 0, 3), Vec3(3, 0, 4), Vec3(2, 1, 5)}, 3.0, {2, 0, 0},
               {2, 0, 3}, E0, V0);
  expect_known("corner exactly over the corner", {Vec3(0, 0, 3), Vec3(1, 0, 4), Vec3(0, 1, 5)}, 3.0,
               {0, 0, 0}, {0, 0, 3}, V0, V0);
  // Parallel features are answered by the middle of their overlap.
  expect_known("parallel edges", {Vec3(1, -2, 0), Vec3(9, -2, 0), Vec3(3, -5, 0)}, 2.0, {2.5, 0, 0},
               {2.5, -2, 0}, E0, E0, 1, 3.0);
  expect_known("edge parallel to a face", {Vec3(1, -1, 2), Vec3(1, 9, 2), Vec3(1, 1, 8)}, 2.0, {1, 1.5, 0},
               {1, 1.5, 2}, FACE, E0, 1, 3.0);
  // The overlap is the unit square with its far corners at (1, 1) and (2, 2).
  expect_known("parallel faces", {Vec3(2, 2, 1), Vec3(2, -2, 1), Vec3(-2, 2, 1)}, 1.0, {1, 1, 0}, {1, 1, 1},
               FACE, FACE, 2, 4.0);
  expect_known("face over a part of a face", {Vec3(1, 1, 1), Vec3(1.75, 1, 1), Vec3(1, 1.75, 1)}, 1.0,
               {1.25, 1.25, 0}, {1.25, 1.25, 1}, FACE, FACE, 2, 0.28125);
  expect_known("piercing", {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(3, -9, 0)}, 0.0, {1.1, 0.5, 0}, {1.1, 0.5, 0},
               FACE, FACE, 1, std::hypot(0.2, 1.0), true);
  expect_known("shared corner", {Vec3(0, 0, 0), Vec3(-3, 0, 1), Vec3(0, -3, 1)}, 0.0, {0, 0, 0}, {0, 0, 0},
               V0, V0, 0, 0.0, true);
  expect_known("shared edge", {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, -3, 1)}, 0.0, {2, 0, 0}, {2, 0, 0}, E0,
               E0, 1, 4.0, true);
  expect_known("corner on a face", {Vec3(1, 1, 0), Vec3(2, 1, 4), Vec3(1, 2, 5)}, 0.0, {1, 1, 0}, {1, 1, 0},
               FACE, V0, 0, 0.0, true);
  expect_known("identical", FLOOR, 0.0, Vec3(4, 4, 0) / 3.0, Vec3(4, 4, 0) / 3.0, FACE, FACE, 2, 8.0, true);
}

TEST(TriangleDistance, CornersAreBitCopies) {
  const Triangle a{Vec3(0.1, 0.2, 0.3), Vec3(1.1, 0.7, 0.2), Vec3(0.3, 1.3, 0.1)};
  const Triangle b{Vec3(-0.7, -0.1, 1.3), Vec3(-2.1, 0.7, 2.2), Vec3(-1.3, -1.3, 3.1)};
  const auto pair = triangle_distance(a, b);
  ASSERT_TRUE(is_vertex(pair.feature_b));
  EXPECT_EQ(pair.point_b, b[local_index(pair.feature_b)]);
}

TEST(TriangleDistance, DegenerateTrianglesAreSegmentsAndPoints) {
  const Triangle segment{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(4, 0, 0)};
  const Triangle point{Vec3(3, 3, 0), Vec3(3, 3, 0), Vec3(3, 3, 0)};
  EXPECT_EQ(triangle_distance(segment, point).squared_distance, 9.0);
  EXPECT_EQ(triangle_distance(point, point).squared_distance, 0.0);
  EXPECT_TRUE(triangle_distance(point, point).intersecting);
  const Triangle across{Vec3(3, -1, 0), Vec3(3, 1, 0), Vec3(3, 0, 0)};
  EXPECT_TRUE(triangle_distance(segment, across).intersecting);
  EXPECT_EQ(triangle_distance(segment, across).squared_distance, 0.0);
}

TEST(TriangleDistance, KnowsThePublishedFailuresOfOthers) {
  // PQP issue 4: nearly parallel edges once gave 687.9.
  const Triangle s{Vec3(8000.0000000000036, 6817.7672478170962, 571.00166381103077),
                   Vec3(7500.0000000000009, 6817.7672478170962, 571.00166381103077),
                   Vec3(7500.0000000000009, 6327.6345143037688, 571.00166381103077)};
  const Triangle t{Vec3(8000.0000000000009, 6327.6345143037670, 88.336618780016408),
                   Vec3(7500.0, 6327.6345143037670, 88.336618780016408),
                   Vec3(7500.0, 6327.6345143037670, 1015.9309593449836)};
  const auto pair = triangle_distance(s, t);
  EXPECT_NEAR(std::sqrt(pair.squared_distance), 1.819e-12, 1e-12);
  EXPECT_FALSE(pair.intersecting);

  // ifc-lite pull request 2815: an edge pierces a slanted face. The minimum over corners and edges
  // alone is not zero.
  const Triangle slanted{Vec3(0, 0, 0), Vec3(10, 0, 2), Vec3(0, 10, 3)};
  const Triangle piercing{Vec3(2, 2, -5), Vec3(3, 3, 5), Vec3(5, 1, 5)};
  for (const auto& pierced : {triangle_distance(slanted, piercing), triangle_distance(piercing, slanted)}) {
    EXPECT_TRUE(pierced.intersecting);
    EXPECT_EQ(pierced.squared_distance, 0.0);
  }
}

TEST(TriangleDistance, NonFiniteInputIsNotANumber) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        Triangle broken = FLOOR;
        broken[corner][axis] = bad;
        EXPECT_TRUE(std::isnan(triangle_distance(FLOOR, broken).squared_distance));
        EXPECT_TRUE(std::isnan(triangle_distance(broken, FLOOR).squared_distance));
      }
    }
  }
}

TEST(TriangleDistance, ExtremeMagnitudesKeepTheirShape) {
  const Triangle a = FLOOR;
  const Triangle b{Vec3(1, 1, 3), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  for (int exponent = -1060; exponent <= 1000; exponent += 20) {
    Triangle scaled_a = a, scaled_b = b;
    for (Triangle* triangle : {&scaled_a, &scaled_b}) {
      for (Vec3& corner : *triangle)
        corner = corner.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    }
    const auto pair = triangle_distance(scaled_a, scaled_b);
    EXPECT_EQ(pair.point_b, scaled_b[0]) << exponent;
    EXPECT_EQ(pair.point_a, Vec3(scaled_b[0][0], scaled_b[0][1], 0.0)) << exponent;
    EXPECT_FALSE(pair.intersecting);
  }
}

}  // namespace
}  // namespace lmdbench
