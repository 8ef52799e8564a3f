// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/rotation_vector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

TEST(RotationVector, TakesTheValuesOfKnownRotations) {
  const double quarter = std::sqrt(0.5);
  EXPECT_TRUE(rotation_vector_of(Eigen::Quaterniond(quarter, 0, 0, quarter))
                  .isApprox(Vec3(0, 0, std::numbers::pi / 2), 1e-15));
  EXPECT_EQ(rotation_vector_of(Eigen::Quaterniond::Identity()), Vec3::Zero());
  EXPECT_TRUE(
      rotation_vector_of(Eigen::Quaterniond(0, 0, 1, 0)).isApprox(Vec3(0, std::numbers::pi, 0), 1e-15));
}

TEST(RotationVector, TurnsAlongTheShorterArcForBothSigns) {
  const Eigen::Quaterniond q = rotation_of(Vec3(0.4, -1.0, 0.8));
  const Eigen::Quaterniond minus_q(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_TRUE(rotation_vector_of(q).isApprox(Vec3(0.4, -1.0, 0.8), 1e-15));
  EXPECT_TRUE(rotation_vector_of(minus_q).isApprox(Vec3(0.4, -1.0, 0.8), 1e-15));
  // 350 degrees one way is 10 degrees the other way.
  const double ten_degrees = std::numbers::pi / 18.0;
  EXPECT_NEAR(rotation_vector_of(rotation_of(Vec3(2.0 * std::numbers::pi - ten_degrees, 0, 0))).x(),
              -ten_degrees, 1e-14);
}

TEST(RotationVector, RoundTripKeepsTheDigitsOfEveryAngle) {
  const Vec3 axis = Vec3(1.0, -2.0, 0.5).normalized();
  for (const double angle : {1e-300, 1e-160, 1e-12, 1e-8, 1e-4, 0.1, 1.0, 3.0, 3.14159}) {
    const Vec3 back = rotation_vector_of(rotation_of(angle * axis));
    EXPECT_NEAR((back - angle * axis).stableNorm() / angle, 0.0, 1e-14) << angle;
  }
}

}  // namespace
}  // namespace lmdbench
