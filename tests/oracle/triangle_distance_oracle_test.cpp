// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>

#include "geometry/every_family.h"
#include <gtest/gtest.h>
#include <judge/distance_bracket.h>
#include <judge/exact_distance.h>
#include <triangles/brute_force_distance.h>

#include <cmath>
#include <limits>
#include <string>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TrianglePair;

/// As in geometry/triangle_families_test.cpp; the published bound is 1e-12.
constexpr double ERROR_BOUND = 2.0 * COINCIDENCE_TOLERANCE;

/// Pairs per family that are judged in rational arithmetic, by far the slowest judge.
constexpr int PAIRS = 1000;
/// Pairs on which it judges the quick judges: extended precision, which the geometry tests use, and
/// the bracket of the accuracy tables.
constexpr int QUICK_PAIRS = 400;
/// Error of the extended precision reference, with room.
constexpr double REFERENCE_BOUND = 1e-15;
/// Rounding of a rational result to a double.
constexpr long double LAST_ROUNDING = std::numeric_limits<double>::epsilon();

class TriangleOracle : public ::testing::TestWithParam<testing::TriangleFamily> {};

TEST_P(TriangleOracle, FindsNoWrongAnswer) {
  Random random(201);
  double worst = 0.0;
  for (int i = 0; i < PAIRS; ++i) {
    const TrianglePair pair = GetParam().generate(random);
    const double magnitude = testing::magnitude(pair);
    const TrianglePairDistance result = triangle_distance(pair.a, pair.b);
    const double truth = testing::exact_distance(pair.a, pair.b);
    const double error = std::abs(std::sqrt(result.squared_distance) - truth);
    ASSERT_LE(error, ERROR_BOUND * magnitude) << "pair " << i << ", exact distance " << truth << paste(pair);
    ASSERT_EQ(result.intersecting, truth == 0.0)
        << "pair " << i << ", exact distance " << truth << paste(pair);
    worst = std::max(worst, error / magnitude);
    if (i % 10 == 0) {
      ASSERT_LE(testing::exact_distance(result.point_a, pair.a), ERROR_BOUND * magnitude) << i << paste(pair);
      ASSERT_LE(testing::exact_distance(result.point_b, pair.b), ERROR_BOUND * magnitude) << i << paste(pair);
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst * 1e16) + "e-16");
}

TEST_P(TriangleOracle, AgreesWithTheQuickJudges) {
  Random random(202);
  for (int i = 0; i < QUICK_PAIRS; ++i) {
    const TrianglePair pair = GetParam().generate(random);
    const double magnitude = testing::magnitude(pair);
    const double truth = testing::exact_distance(pair.a, pair.b);
    const auto reference = static_cast<double>(testing::brute_force_distance(pair.a, pair.b));
    ASSERT_NEAR(reference, truth, REFERENCE_BOUND * magnitude) << i << paste(pair);
    const testing::DistanceBracket bracket = testing::distance_bracket(pair.a, pair.b);
    ASSERT_LE(bracket.low, truth * (1.0L + LAST_ROUNDING)) << i << paste(pair);
    ASSERT_GE(bracket.high, truth * (1.0L - LAST_ROUNDING)) << i << paste(pair);
    ASSERT_LE(bracket.high - bracket.low,
              testing::BRACKET_WIDTH * magnitude + 2.0L * LAST_ROUNDING * truth * (bracket.bits == 0))
        << i << paste(pair);
    ASSERT_EQ(testing::exactly_touch(pair.a, pair.b), truth == 0.0) << i << paste(pair);
  }
}

INSTANTIATE_TEST_SUITE_P(All, TriangleOracle, testing::every_family(), testing::family_test_name);

}  // namespace
}  // namespace lmdbench
