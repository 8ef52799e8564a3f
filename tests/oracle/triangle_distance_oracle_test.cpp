// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>

#include "geometry/brute_force_distance.h"
#include "geometry/triangle_families.h"
#include "oracle/exact_distance.h"
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <string>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TrianglePair;

/// As in geometry/triangle_families_test.cpp; the published bound is 1e-12.
constexpr double ERROR_BOUND = 2.0 * COINCIDENCE_TOLERANCE;

/// So many pairs, and every hundredth after them, are judged in rational arithmetic. In between, extended
/// precision answers for it where it can: where it agrees with the kernel and the triangles clearly do not
/// touch.
constexpr int EXACT_PAIRS = 1000;
constexpr int EXACT_STRIDE = 100;
/// Error of the extended precision reference, with room; this test checks it on every pair that is judged
/// twice.
constexpr double REFERENCE_BOUND = 1e-15;

/// Pairs a family; the long run sets LMDBENCH_ORACLE_PAIRS to a million.
int pairs_a_family() {
  const char* text = std::getenv("LMDBENCH_ORACLE_PAIRS");
  return text != nullptr ? std::atoi(text) : EXACT_PAIRS;
}

std::string paste(const TrianglePair& pair) {
  std::ostringstream text;
  text << std::setprecision(17) << "\n";
  for (const Triangle* t : {&pair.a, &pair.b}) {
    text << "Triangle{";
    for (const Vec3& p : *t) text << "Vec3(" << p[0] << ", " << p[1] << ", " << p[2] << "), ";
    text << "}\n";
  }
  return text.str();
}

class TriangleOracle : public ::testing::TestWithParam<testing::TriangleFamily> {};

TEST_P(TriangleOracle, FindsNoWrongAnswer) {
  Random random(201);
  const int count = pairs_a_family();
  ASSERT_GT(count, 0);
  double worst = 0.0;
  int judged_exactly = 0;
  for (int i = 0; i < count; ++i) {
    const TrianglePair pair = GetParam().generate(random);
    const double magnitude = testing::magnitude(pair);
    const TrianglePairDistance result = triangle_distance(pair.a, pair.b);
    const auto reference = static_cast<double>(testing::brute_force_distance(pair.a, pair.b));
    const double distance = std::sqrt(result.squared_distance);
    const bool in_doubt = result.intersecting || reference <= REFERENCE_BOUND * magnitude ||
                          !(std::abs(distance - reference) <= 0.5 * ERROR_BOUND * magnitude);
    const bool exactly = in_doubt || i < EXACT_PAIRS || i % EXACT_STRIDE == 0;
    const double truth = exactly ? testing::exact_distance(pair.a, pair.b) : reference;
    judged_exactly += exactly;
    if (exactly) {
      ASSERT_NEAR(reference, truth, REFERENCE_BOUND * magnitude) << i << paste(pair);
    }
    const double error = std::abs(distance - truth);
    ASSERT_LE(error, ERROR_BOUND * magnitude) << "pair " << i << ", exact distance " << truth << paste(pair);
    ASSERT_EQ(result.intersecting, truth == 0.0)
        << "pair " << i << ", exact distance " << truth << paste(pair);
    worst = std::max(worst, error / magnitude);
    if (i < EXACT_PAIRS && i % 10 == 0) {
      ASSERT_LE(testing::exact_distance(result.point_a, pair.a), ERROR_BOUND * magnitude) << i << paste(pair);
      ASSERT_LE(testing::exact_distance(result.point_b, pair.b), ERROR_BOUND * magnitude) << i << paste(pair);
    }
  }
  RecordProperty("judged_exactly", judged_exactly);
  RecordProperty("worst_relative_error", std::to_string(worst * 1e16) + "e-16");
}

INSTANTIATE_TEST_SUITE_P(All, TriangleOracle,
                         ::testing::ValuesIn(testing::triangle_families().begin(),
                                             testing::triangle_families().end()),
                         [](const auto& parameter) {
                           std::string name;
                           for (const char c : parameter.param.name) {
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           }
                           return name;
                         });

}  // namespace
}  // namespace lmdbench
