// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_distance_steps.h>

#include "geometry/every_family.h"
#include <gtest/gtest.h>
#include <triangles/brute_force_distance.h>

#include <cmath>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TriangleFamily;
using testing::TrianglePair;

/// Largest error of a distance, relative to the largest coordinate: COINCIDENCE_TOLERANCE where
/// edges count as parallel, and a few roundings. The published bound is 1e-12.
constexpr double KERNEL_ERROR_BOUND = 2.0 * COINCIDENCE_TOLERANCE;

constexpr int PAIRS = 10000;

class TriangleFamilies : public ::testing::TestWithParam<TriangleFamily> {};

/// Compares with the brute force and checks the result's invariants.
void expect_right(const TrianglePair& pair) {
  const TrianglePairDistance result = triangle_distance(pair.a, pair.b);
  const double bound = KERNEL_ERROR_BOUND * testing::magnitude(pair);
  const auto truth = static_cast<double>(testing::brute_force_distance(pair.a, pair.b));
  ASSERT_NEAR(std::sqrt(result.squared_distance), truth, bound) << paste(pair);
  ASSERT_EQ(result.squared_distance, (result.point_a - result.point_b).squaredNorm()) << paste(pair);
  ASSERT_TRUE(!result.intersecting || result.squared_distance == 0.0) << paste(pair);
  const auto off = [](const Vec3& p, const Triangle& t) {
    return static_cast<double>(testing::brute_force_distance({p, p, p}, t));
  };
  ASSERT_LE(off(result.point_a, pair.a), bound) << paste(pair);
  ASSERT_LE(off(result.point_b, pair.b), bound) << paste(pair);
  // A corner is copied bit by bit; of two touching corners that differ in bits, only one is.
  const bool copy_a = is_vertex(result.feature_a) && result.point_a == pair.a[local_index(result.feature_a)];
  const bool copy_b = is_vertex(result.feature_b) && result.point_b == pair.b[local_index(result.feature_b)];
  ASSERT_TRUE(!is_vertex(result.feature_a) || copy_a || (result.intersecting && copy_b)) << paste(pair);
  ASSERT_TRUE(!is_vertex(result.feature_b) || copy_b || (result.intersecting && copy_a)) << paste(pair);
}

TEST_P(TriangleFamilies, AreRight) {
  Random random(101);
  for (int i = 0; i < PAIRS; ++i) {
    ASSERT_NO_FATAL_FAILURE(expect_right(GetParam().generate(random))) << "pair " << i;
  }
}

TEST_P(TriangleFamilies, AreRightAtEveryScaleAndPlace) {
  Random random(102);
  for (int i = 0; i < PAIRS / 5; ++i) {
    TrianglePair pair = GetParam().generate(random);
    if (testing::magnitude(pair) > 1e6 || testing::magnitude(pair) < 1e-6) continue;
    const double scale = testing::log_uniform(random, 1e-6, 1e6);
    pair = testing::transformed(pair, scale, Mat3::Identity(), Vec3::Zero());
    ASSERT_NO_FATAL_FAILURE(expect_right(pair)) << "pair " << i << " scaled";
    const Vec3 place = testing::log_uniform(random, 1.0, 1e6) * testing::random_point(random);
    pair = testing::transformed(pair, 1.0, testing::random_rotation_matrix(random), place);
    ASSERT_NO_FATAL_FAILURE(expect_right(pair)) << "pair " << i << " moved";
  }
}

void expect_same_bits(const TrianglePairDistance& x, const TrianglePairDistance& y,
                      const TrianglePair& pair) {
  ASSERT_EQ(x.squared_distance, y.squared_distance) << paste(pair);
  ASSERT_EQ(x.point_a, y.point_a) << paste(pair);
  ASSERT_EQ(x.point_b, y.point_b) << paste(pair);
  ASSERT_EQ(x.intersecting, y.intersecting) << paste(pair);
  ASSERT_EQ(x.minimiser_dimension, y.minimiser_dimension) << paste(pair);
  ASSERT_EQ(x.minimiser_measure, y.minimiser_measure) << paste(pair);
}

TEST_P(TriangleFamilies, DoNotDependOnOrder) {
  Random random(103);
  for (int i = 0; i < 300; ++i) {
    const TrianglePair pair = GetParam().generate(random);
    const TrianglePairDistance first = triangle_distance(pair.a, pair.b);
    for (int order = 1; order < 72; ++order) {
      const TrianglePair other = testing::reordered(pair, order);
      TrianglePairDistance again = triangle_distance(other.a, other.b);
      if (order >= 36) {
        std::swap(again.point_a, again.point_b);
        std::swap(again.feature_a, again.feature_b);
      }
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(first, again, pair)) << "pair " << i << " order " << order;
      ASSERT_EQ(is_face(first.feature_a), is_face(again.feature_a));
      ASSERT_EQ(is_vertex(first.feature_b), is_vertex(again.feature_b));
      if (order != 36) continue;  // The plain swap; the others number the features anew.
      ASSERT_EQ(first.feature_a, again.feature_a);
      ASSERT_EQ(first.feature_b, again.feature_b);
    }
  }
}

TEST_P(TriangleFamilies, TheProofAndTheExaminationOfAllCandidatesAgree) {
  Random random(104);
  for (int i = 0; i < PAIRS; ++i) {
    const TrianglePair pair = GetParam().generate(random);
    const double magnitude = testing::magnitude(pair);
    if (magnitude > 0x1p100 || magnitude < 0x1p-100) continue;  // outside what both are for
    const double tolerance = coincidence_length(magnitude);
    TrianglePairDistance proved;
    if (!kernel::prove_by_features(pair.a, pair.b, tolerance, proved)) continue;
    const TrianglePairDistance examined = kernel::distance_by_all_candidates(pair.a, pair.b, tolerance);
    ASSERT_NO_FATAL_FAILURE(expect_same_bits(proved, examined, pair)) << "pair " << i;
    ASSERT_EQ(proved.feature_a, examined.feature_a) << paste(pair);
    ASSERT_EQ(proved.feature_b, examined.feature_b) << paste(pair);
  }
}

INSTANTIATE_TEST_SUITE_P(All, TriangleFamilies, testing::every_family(), testing::family_test_name);

}  // namespace
}  // namespace lmdbench
