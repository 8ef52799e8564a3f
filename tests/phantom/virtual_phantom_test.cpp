// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/virtual_phantom.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

Wrench command(const Vec3& force) {
  Wrench wrench;
  wrench.force = force;
  wrench.torque = Vec3(1.0, 2.0, 3.0);
  return wrench;
}

const VirtualPhantom DESKTOP(device_named("phantom-desktop"));  // 7.9 N largest, 1.75 N continuous

TEST(VirtualPhantom, RendersWhatItCan) {
  const RenderedForce gentle = DESKTOP.render(command(Vec3(1.0, -1.0, 0.5)));
  EXPECT_EQ(gentle.force, Vec3(1.0, -1.0, 0.5));
  EXPECT_FALSE(gentle.clipped);
  EXPECT_FALSE(gentle.exceeds_continuous_force);

  const RenderedForce strong = DESKTOP.render(command(Vec3(0.0, 3.0, -4.0)));
  EXPECT_EQ(strong.force, Vec3(0.0, 3.0, -4.0));
  EXPECT_FALSE(strong.clipped);
  EXPECT_TRUE(strong.exceeds_continuous_force);
}

TEST(VirtualPhantom, ClipsTheLengthAndKeepsTheDirection) {
  // Every component alone is within the limit: only the length is not.
  const Vec3 force(6.0, -6.0, 3.0);
  const RenderedForce rendered = DESKTOP.render(command(force));
  EXPECT_TRUE(rendered.clipped);
  EXPECT_TRUE(rendered.exceeds_continuous_force);
  EXPECT_NEAR(rendered.force.norm(), 7.9, 1e-14);
  EXPECT_LT(rendered.force.cross(force).norm(), 1e-13);
  EXPECT_GT(rendered.force.dot(force), 0.0);
}

TEST(VirtualPhantom, LimitsThemselvesAreNotExceeded) {
  const RenderedForce largest = DESKTOP.render(command(Vec3(7.9, 0, 0)));
  EXPECT_FALSE(largest.clipped);
  EXPECT_EQ(largest.force, Vec3(7.9, 0, 0));
  EXPECT_FALSE(DESKTOP.render(command(Vec3(0, -1.75, 0))).exceeds_continuous_force);
}

TEST(VirtualPhantom, RoundingExceedsNothing) {
  const Vec3 along = Vec3(1.0, 1.0, 1.0) / std::sqrt(3.0);
  for (const double ulps : {1.0, 4.0}) {
    const double longer = 1.0 + ulps * std::numeric_limits<double>::epsilon();
    EXPECT_FALSE(DESKTOP.render(command(7.9 * longer * along)).clipped);
    EXPECT_FALSE(DESKTOP.render(command(1.75 * longer * along)).exceeds_continuous_force);
  }
  EXPECT_TRUE(DESKTOP.render(command(7.9 * (1.0 + 1e-11) * along)).clipped);
  EXPECT_TRUE(DESKTOP.render(command(1.75 * (1.0 + 1e-11) * along)).exceeds_continuous_force);
}

TEST(VirtualPhantom, TorqueIsRenderedByThoseThatActuateItAndClippedByItself) {
  EXPECT_EQ(DESKTOP.render(command(Vec3(1.0, 0.0, 0.0))).torque, Vec3::Zero());
  EXPECT_FALSE(DESKTOP.render(command(Vec3(1.0, 0.0, 0.0))).torque_clipped);
  const VirtualPhantom turning(device_named("phantom-premium-1.5-6dof"));  // 0.188 N m
  const RenderedForce strong = turning.render(command(Vec3(1.0, 0.0, 0.0)));
  EXPECT_TRUE(strong.torque_clipped);
  EXPECT_FALSE(strong.clipped);
  EXPECT_TRUE(strong.torque.isApprox(0.188 * Vec3(1.0, 2.0, 3.0).normalized(), 1e-14));
  Wrench gentle;
  gentle.torque = Vec3(0.0, 0.188, 0.0);
  EXPECT_EQ(turning.render(gentle).torque, gentle.torque);
  EXPECT_FALSE(turning.render(gentle).torque_clipped);
  EXPECT_EQ(VirtualPhantom(device_named("ideal")).render(command(Vec3::Zero())).torque, Vec3(1.0, 2.0, 3.0));
}

TEST(VirtualPhantom, HugeForcesAreClippedWithoutOverflow) {
  const RenderedForce rendered = DESKTOP.render(command(Vec3(1e300, 1e300, 0.0)));
  EXPECT_TRUE(rendered.clipped);
  EXPECT_NEAR(rendered.force.x(), 7.9 / std::sqrt(2.0), 1e-13);
}

TEST(VirtualPhantom, NanStaysVisible) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RenderedForce rendered = DESKTOP.render(command(Vec3(nan, 0, 0)));
  EXPECT_TRUE(std::isnan(rendered.force.x()));
  EXPECT_FALSE(rendered.clipped);
}

TEST(VirtualPhantom, ClippingDependsOnTheDevice) {
  const Vec3 force(0, 0, 5.0);
  EXPECT_FALSE(DESKTOP.render(command(force)).clipped);
  EXPECT_TRUE(VirtualPhantom(device_named("phantom-omni")).render(command(force)).clipped);
}

TEST(VirtualPhantom, LowerLimitThanTheDevicesCanBeSet) {
  EXPECT_NEAR(DESKTOP.render(command(Vec3(0.0, 4.0, 3.0)), 3.0).force.norm(), 3.0, 1e-15);
  EXPECT_TRUE(DESKTOP.render(command(Vec3(0.0, 4.0, 3.0)), 3.0).clipped);
  EXPECT_EQ(DESKTOP.limit(100.0), 7.9) << "the device's own stays";
}

}  // namespace
}  // namespace lmdbench
