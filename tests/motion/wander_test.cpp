// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/rotation_vector.h>
#include <lmdbench/motion/wander.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

TEST(Wander, TurnsAtTheWantedRate) {
  std::mt19937_64 generator(3);
  double sum_of_squares = 0.0;
  int count = 0;
  for (int sample = 0; sample < 50; ++sample) {
    const Wander wander(0.5, generator);
    for (int i = 0; i < 400; ++i, ++count) sum_of_squares += wander.angular_velocity(0.25 * i).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 0.5, 0.01);
}

TEST(Wander, RotationsFollowTheAngularVelocity) {
  std::mt19937_64 generator(4);
  const Wander wander(0.7, generator);
  const Eigen::Quaterniond start = uniform_rotation(generator);
  const auto rotations = wander.rotations(start, 0.001, 3001);
  ASSERT_EQ(rotations.size(), 3001u);
  EXPECT_EQ(rotations.front().coeffs(), start.coeffs());
  for (std::size_t k = 0; k + 1 < rotations.size(); k += 50) {
    const Vec3 turn = rotation_vector_of(rotations[k + 1] * rotations[k].conjugate()) / 0.001;
    EXPECT_LT((turn - wander.angular_velocity((static_cast<double>(k) + 0.5) * 0.001)).norm(), 1e-9);
  }
  // With a tenth of the time step the path ends at the same place.
  const auto fine = wander.rotations(start, 0.0001, 30001);
  EXPECT_LT(rotation_vector_of(fine.back() * rotations.back().conjugate()).norm(), 1e-6);
}

TEST(Wander, DependsOnTheSeedAlone) {
  std::mt19937_64 a(9);
  std::mt19937_64 b(9);
  std::mt19937_64 c(10);
  const Vec3 first = Wander(1.0, a).angular_velocity(0.3);
  EXPECT_EQ(first, Wander(1.0, b).angular_velocity(0.3));
  EXPECT_NE(first, Wander(1.0, c).angular_velocity(0.3));
}

TEST(UniformRotation, CoversAllDirections) {
  std::mt19937_64 generator(1);
  Vec3 mean = Vec3::Zero();
  Mat3 spread = Mat3::Zero();
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Eigen::Quaterniond rotation = uniform_rotation(generator);
    EXPECT_NEAR(rotation.norm(), 1.0, 1e-15);
    const Vec3 x = rotation * Vec3::UnitX();
    mean += x / count;
    spread += x * x.transpose() / count;
  }
  EXPECT_LT(mean.norm(), 0.02);
  EXPECT_LT((spread - Mat3::Identity() / 3.0).norm(), 0.02);
}

}  // namespace
}  // namespace lmdbench
