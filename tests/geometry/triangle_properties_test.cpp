// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/original/feature_points.h>

#include <triangles/triangle_families.h>
// RapidCheck's header uses GoogleTest without including it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TrianglePair;

/// Each of two distances of one pair may be off by half of this part of the largest coordinate (see
/// triangle_families_test.cpp).
constexpr double DIFFERENCE_BOUND = 4.0 * COINCIDENCE_TOLERANCE;

double distance(const TrianglePair& pair) {
  return std::sqrt(triangle_distance(pair.a, pair.b).squared_distance);
}

/// A pair of any family whose magnitudes leave room for a transform.
TrianglePair any_pair(Random& random) {
  const auto families = testing::triangle_families();
  for (;;) {
    const TrianglePair pair =
        families[testing::random_index(random, static_cast<int>(families.size()))].generate(random);
    const double size = testing::magnitude(pair);
    if (size > 1e-7 && size < 1e7) return pair;
  }
}

/// RapidCheck draws a seed, which it can print and replay; each seed gives a number of pairs.
Random seeded() {
  return Random(*rc::gen::arbitrary<std::uint64_t>());
}
constexpr int PAIRS_A_SEED = 100;

RC_GTEST_PROP(TriangleDistanceProperty, IsSymmetric, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    const TrianglePair pair = any_pair(random);
    const auto forward = triangle_distance(pair.a, pair.b);
    const auto backward = triangle_distance(pair.b, pair.a);
    RC_ASSERT(forward.squared_distance == backward.squared_distance);
    RC_ASSERT(forward.point_a == backward.point_b);
    RC_ASSERT(forward.point_b == backward.point_a);
    RC_ASSERT(forward.feature_a == backward.feature_b);
    RC_ASSERT(forward.feature_b == backward.feature_a);
  }
}

RC_GTEST_PROP(TriangleDistanceProperty, DoesNotChangeUnderRigidMotion, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    const TrianglePair pair = any_pair(random);
    const double size = testing::magnitude(pair);
    const TrianglePair moved = testing::transformed(pair, 1.0, testing::random_rotation_matrix(random),
                                                    size * 3.0 * testing::random_point(random));
    // The motion itself rounds every corner.
    const double bound = DIFFERENCE_BOUND * (size + testing::magnitude(moved));
    RC_ASSERT(std::abs(distance(pair) - distance(moved)) <= bound);
  }
}

RC_GTEST_PROP(TriangleDistanceProperty, ScalesWithTheTriangles, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    const TrianglePair pair = any_pair(random);
    // A power of two changes no bit but the exponent.
    const double power = std::ldexp(1.0, testing::random_index(random, 81) - 40);
    const TrianglePair doubled = testing::transformed(pair, power, Mat3::Identity(), Vec3::Zero());
    RC_ASSERT(triangle_distance(doubled.a, doubled.b).squared_distance ==
              power * power * triangle_distance(pair.a, pair.b).squared_distance);
    const double factor = testing::log_uniform(random, 1e-6, 1e6);
    const TrianglePair scaled = testing::transformed(pair, factor, Mat3::Identity(), Vec3::Zero());
    RC_ASSERT(std::abs(factor * distance(pair) - distance(scaled)) <=
              DIFFERENCE_BOUND * testing::magnitude(scaled));
  }
}

RC_GTEST_PROP(TriangleDistanceProperty, IsOneLipschitzAlongAMotion, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    TrianglePair pair = any_pair(random);
    const double size = testing::magnitude(pair);
    double before = distance(pair);
    for (int step = 0; step < 20; ++step) {
      // From one unit in the last place to a micrometre of a metre-sized triangle.
      const Vec3 move = size * testing::log_uniform(random, 1e-16, 1e-6) * testing::random_point(random);
      double moved = 0.0;
      for (Vec3& corner : pair.b) {
        const Vec3 old = corner;
        corner += move;
        moved = std::max(moved, (corner - old).norm());
      }
      const double after = distance(pair);
      RC_ASSERT(std::abs(after - before) <= moved + DIFFERENCE_BOUND * size);
      before = after;
    }
  }
}

RC_GTEST_PROP(TriangleDistanceProperty, AnEdgeGivesTheSameBitsFromBothOfItsTriangles, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    const TrianglePair pair = any_pair(random);
    // The neighbour has edge 0 in the other direction, and no larger coordinates.
    const Vec3 third = pair.a[0] + pair.a[1] - pair.a[2];
    const Triangle neighbour{pair.a[1], pair.a[0], 0.5 * (third + pair.a[0])};
    const auto first = triangle_distance(pair.a, pair.b);
    const auto second = triangle_distance(neighbour, pair.b);
    const bool on_edge_of_both =
        first.feature_a == TriangleFeature::E0 && second.feature_a == TriangleFeature::E0;
    const bool on_corner_of_both =
        (first.feature_a == TriangleFeature::V0 && second.feature_a == TriangleFeature::V1) ||
        (first.feature_a == TriangleFeature::V1 && second.feature_a == TriangleFeature::V0);
    if (!on_edge_of_both && !on_corner_of_both) continue;
    if (first.feature_b != second.feature_b || first.intersecting || second.intersecting) continue;
    if (first.minimiser_dimension != second.minimiser_dimension) continue;
    RC_ASSERT(first.point_a == second.point_a);
    RC_ASSERT(first.point_b == second.point_b);
    RC_ASSERT(first.squared_distance == second.squared_distance);
  }
}

/// No point of the triangle is farther than this from a feature point. Corners and edge middles cut
/// it into four copies of half its size; balls of 1/sqrt(3) of a triangle's longest edge round its
/// corners cover it (Jung).
double covering_radius(const Triangle& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()}) /
         (2.0 * std::sqrt(3.0));
}

RC_GTEST_PROP(TriangleDistanceProperty, IsBoundedByTheFeaturePoints, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    const TrianglePair pair = any_pair(random);
    double by_points = HUGE_VAL;
    for (const Vec3& p : feature_points<7>(pair.a)) {
      for (const Vec3& q : feature_points<7>(pair.b)) by_points = std::min(by_points, (q - p).norm());
    }
    const double slack = DIFFERENCE_BOUND * testing::magnitude(pair);
    RC_ASSERT(distance(pair) <= by_points + slack);
    RC_ASSERT(by_points <= distance(pair) + covering_radius(pair.a) + covering_radius(pair.b) + slack);
  }
}

}  // namespace
}  // namespace lmdbench
