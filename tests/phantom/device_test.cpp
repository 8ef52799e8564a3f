// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/device.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <cmath>
#include <set>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Device, LargestForcesAreThoseOfTheSources) {
  EXPECT_EQ(device_named("phantom-desktop").maximum_force.value, 7.9);
  EXPECT_EQ(device_named("phantom-premium-1.5").maximum_force.value, 8.5);
  EXPECT_EQ(device_named("phantom-premium-1.5-6dof").maximum_force.value, 8.5);
  EXPECT_EQ(device_named("phantom-omni").maximum_force.value, 3.3);
  EXPECT_EQ(device_named("phantom-premium-3.0-6dof").maximum_force.value, 22.0);
}

void expect_sound(const DeviceFigure& figure, std::string_view unit) {
  EXPECT_EQ(figure.unit, unit);
  EXPECT_EQ(std::isnan(figure.value), figure.trust == Trust::UNKNOWN);
  EXPECT_EQ(figure.source.empty(), figure.trust == Trust::UNKNOWN);
  if (figure.trust == Trust::STATED || figure.trust == Trust::FROM_MEMORY) {
    EXPECT_GT(figure.value, 0.0);
  }
}

TEST(Device, EveryFigureHasUnitSourceAndTrust) {
  std::set<std::string_view> names;
  for (const Device& device : known_devices()) {
    SCOPED_TRACE(device.name);
    EXPECT_TRUE(names.insert(device.name).second) << "the name is used twice";
    EXPECT_FALSE(device.title.empty());
    expect_sound(device.maximum_force, "N");
    expect_sound(device.continuous_force, "N");
    expect_sound(device.position_resolution, "m");
    expect_sound(device.apparent_mass, "kg");
    expect_sound(device.damping, "N s/m");
    expect_sound(device.friction, "N");
    expect_sound(device.torque, "N m");
    if (device.maximum_force.trust == Trust::DEFINED) continue;
    // Rendering depends on these two limits, which must be known, in this order.
    EXPECT_LT(device.continuous_force.value, device.maximum_force.value);
    EXPECT_EQ(device.maximum_force.trust, Trust::STATED);
    // Units slip most easily in the small figures.
    EXPECT_LT(device.position_resolution.value, 1e-4);
    EXPECT_LT(device.apparent_mass.value, 0.2);
  }
  EXPECT_EQ(names.size(), 6u);
}

TEST(Device, IdealDeviceLimitsNothing) {
  const Device& ideal = device_named("ideal");
  EXPECT_EQ(ideal.friction.value, 0.0);
  EXPECT_EQ(ideal.position_resolution.value, 0.0);
  EXPECT_TRUE(std::isinf(ideal.maximum_force.value));
  EXPECT_EQ(ideal.apparent_mass.value, 0.04);
  EXPECT_EQ(ideal.damping.value, 0.8);
}

TEST(Device, UnknownNameListsTheKnownOnes) {
  EXPECT_THAT(testing::message_of<UsageError>([] { device_named("phantom-desk", "hard.json", "/device"); }),
              AllOf(HasSubstr("hard.json: /device: there is no device 'phantom-desk'"),
                    HasSubstr("phantom-desktop"), HasSubstr("phantom-omni")));
}

}  // namespace
}  // namespace lmdbench
