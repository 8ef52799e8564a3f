// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

const ForceProfile LINEAR_PROFILE = {.law = ForceLaw::LINEAR,
                                     .cutoff = 0.010,
                                     .saturation_distance = 0.002,
                                     .maximum_force = 8.0,
                                     .sharpness = 0.0};
const ForceProfile EXPONENTIAL_PROFILE = {.law = ForceLaw::EXPONENTIAL,
                                          .cutoff = 0.010,
                                          .saturation_distance = 0.002,
                                          .maximum_force = 8.0,
                                          .sharpness = 4.0};

Lmd lmd_at(const Vec3& point_moving, const Vec3& direction, double distance) {
  Lmd lmd;
  lmd.distance = distance;
  lmd.point_moving = point_moving;
  lmd.direction = direction;
  lmd.point_fixed = point_moving + distance * direction;
  return lmd;
}

TEST(SumForces, PushesTheMovingMeshAway) {
  // The fixed mesh is below the moving one, so the force on the moving one points up.
  const Wrench wrench =
      sum_forces({lmd_at(Vec3(0.1, 0, 0), -Vec3::UnitZ(), 0.006)}, LINEAR_PROFILE, Vec3::Zero());
  EXPECT_TRUE(wrench.force.isApprox(Vec3(0, 0, 4.0), 1e-14));
  EXPECT_TRUE(wrench.torque.isApprox(Vec3(0, -0.4, 0), 1e-14));  // x cross z = -y
  EXPECT_NEAR(wrench.stiffness, 1000.0, 1e-9);
}

TEST(SumForces, TorqueIsTakenAboutTheReferencePoint) {
  const Wrench wrench =
      sum_forces({lmd_at(Vec3(0.1, 0, 0), -Vec3::UnitZ(), 0.006)}, LINEAR_PROFILE, Vec3(0.1, 0.05, 7.0));
  EXPECT_TRUE(wrench.torque.isApprox(Vec3(-0.2, 0, 0), 1e-14));  // -y cross z = -x
}

TEST(SumForces, NEqualContactsGiveNTimesForceAndStiffness) {
  const LmdSet lmds(7, lmd_at(Vec3::Zero(), Vec3::UnitX(), 0.005));
  const Wrench one = sum_forces({lmds.front()}, EXPONENTIAL_PROFILE, Vec3::Zero());
  const Wrench seven = sum_forces(lmds, EXPONENTIAL_PROFILE, Vec3::Zero());
  EXPECT_NEAR(seven.force.x(), 7.0 * one.force.x(), 1e-13);
  EXPECT_LT(seven.force.x(), 0.0);
  EXPECT_NEAR(seven.stiffness, 7.0 * one.stiffness, 1e-9);
}

TEST(SumForces, StiffnessIsTheSlopeAlongTheForceForFlatContacts) {
  // Two planes that meet: a translation by x reduces distances by n.x; directions stay.
  const Vec3 n0 = Vec3(0.3, -0.2, -1.0).normalized();
  const Vec3 n1 = Vec3(-0.5, 0.4, -0.6).normalized();
  const auto force_at = [&](const Vec3& x) {
    return sum_forces(
        {lmd_at(Vec3::Zero(), n0, 0.005 - n0.dot(x)), lmd_at(Vec3::Zero(), n1, 0.007 - n1.dot(x))},
        EXPONENTIAL_PROFILE, Vec3::Zero());
  };
  const Wrench here = force_at(Vec3::Zero());
  const Vec3 along = here.force.normalized();
  const double h = 1e-8;
  const double slope = (force_at(-h * along).force.norm() - force_at(h * along).force.norm()) / (2.0 * h);
  EXPECT_NEAR(here.stiffness, slope, 1e-5 * slope);
}

TEST(SumForces, BeyondTheCutoffAddsNothing) {
  const Lmd near = lmd_at(Vec3::Zero(), Vec3::UnitY(), 0.004);
  const Wrench alone = sum_forces({near}, EXPONENTIAL_PROFILE, Vec3::Zero());
  const Wrench both =
      sum_forces({near, lmd_at(Vec3::Zero(), Vec3::UnitX(), 0.010)}, EXPONENTIAL_PROFILE, Vec3::Zero());
  EXPECT_EQ(alone.force, both.force);
  EXPECT_EQ(alone.stiffness, both.stiffness);
}

TEST(SumForces, EmptySetIsNoForce) {
  const Wrench wrench = sum_forces({}, EXPONENTIAL_PROFILE, Vec3::Zero());
  EXPECT_EQ(wrench.force, Vec3::Zero());
  EXPECT_EQ(wrench.torque, Vec3::Zero());
  EXPECT_EQ(wrench.stiffness, 0.0);
}

TEST(SumForces, IntersectingLmdPushesAlongItsLastDirectionOrNotAtAll) {
  Lmd touching = lmd_at(Vec3(0, 0.1, 0), Vec3::UnitX(), 0.0);
  touching.intersecting = true;
  EXPECT_EQ(sum_forces({touching}, EXPONENTIAL_PROFILE, Vec3::Zero()).force, Vec3(-8.0, 0, 0));

  touching.direction = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const Lmd other = lmd_at(Vec3::Zero(), Vec3::UnitY(), 0.004);
  const Wrench with = sum_forces({touching, other}, EXPONENTIAL_PROFILE, Vec3::Zero());
  const Wrench without = sum_forces({other}, EXPONENTIAL_PROFILE, Vec3::Zero());
  EXPECT_EQ(with.force, without.force);
  EXPECT_EQ(with.torque, without.torque);
  EXPECT_EQ(with.stiffness, without.stiffness);
}

TEST(SumForces, BrokenLmdStaysVisible) {
  Lmd broken = lmd_at(Vec3::Zero(), Vec3::UnitX(), 0.004);
  broken.direction = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(sum_forces({broken}, EXPONENTIAL_PROFILE, Vec3::Zero()).force.hasNaN());
  EXPECT_TRUE(std::isnan(sum_forces({broken}, EXPONENTIAL_PROFILE, Vec3::Zero()).stiffness));
}

TEST(SumForces, BalancedForcesReportTheStiffestDirection) {
  const LmdSet squeezed = {lmd_at(Vec3::Zero(), Vec3::UnitX(), 0.004),
                           lmd_at(Vec3::Zero(), -Vec3::UnitX(), 0.004)};
  const Wrench wrench = sum_forces(squeezed, LINEAR_PROFILE, Vec3::Zero());
  EXPECT_EQ(wrench.force, Vec3::Zero());
  EXPECT_NEAR(wrench.stiffness, 2000.0, 1e-9);
}

/// As between two walls that stand askew: their sum is rounding, and has no direction.
TEST(SumForces, ForcesThatCancelToRoundingAreBalanced) {
  const Vec3 askew = Vec3(1, 2, 3).normalized();
  LmdSet squeezed = {lmd_at(Vec3::Zero(), askew, 0.004), lmd_at(Vec3::Zero(), -askew, 0.004)};
  squeezed[1].direction += Vec3(1e-16, -1e-16, 2e-16);
  const Wrench wrench = sum_forces(squeezed, LINEAR_PROFILE, Vec3::Zero());
  EXPECT_EQ(wrench.force, Vec3::Zero());
  EXPECT_NEAR(wrench.stiffness, 2000.0, 1e-9);
}

}  // namespace
}  // namespace lmdbench
