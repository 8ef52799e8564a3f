// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>

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

RC_GTEST_PROP(TriangleDistanceProperty, ScalesWithTheTriangles, ()) {
  Random random = seeded();
  for (int pair_number = 0; pair_number < PAIRS_A_SEED; ++pair_number) {
    const TrianglePair pair = any_pair(random);
    // A power of two changes no bit but the exponent.
    const double power = std::ldexp(1.0, testing::random_index(random, 81) - 40);
    const TrianglePair doubled = testing::transformed(pair, power, Mat3::Identity(), Vec3::Zero());
    RC_ASSERT(triangle_distance(doubled.a, doubled.b).squared_distance ==
              power * power * triangle_distance(pair.a, pair.b).squared_distance);
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

}  // namespace
}  // namespace lmdbench
