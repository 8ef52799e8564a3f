// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/rotation_vector.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

/// A screw: constant velocity and angular velocity in the world.
Pose screw(double frame) {
  return {Vec3(0.1, -0.2, 0.3) + frame * Vec3(1e-3, 2e-3, -5e-4),
          rotation_of(frame * Vec3(0.02, -0.01, 0.03)) * Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};
}

TEST(Extrapolated, GoesOnAsBefore) {
  for (const double frames : {0.0, 1.0, 7.0, 20.0}) {
    const Pose reached = extrapolated(screw(3.0), screw(4.0), frames);
    const Pose expected = screw(4.0 + frames);
    EXPECT_LT((reached.translation - expected.translation).norm(), 1e-15) << frames;
    EXPECT_LT(reached.rotation.angularDistance(expected.rotation), 1e-13) << frames;
  }
}

TEST(Extrapolated, StaysWhereItRests) {
  const Pose rest = screw(1.0);
  const Pose reached = extrapolated(rest, rest, 50.0);
  EXPECT_EQ(reached.translation, rest.translation);
  EXPECT_LT(reached.rotation.angularDistance(rest.rotation), 1e-15);
}

}  // namespace
}  // namespace lmdbench
