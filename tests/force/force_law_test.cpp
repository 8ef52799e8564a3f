// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/force/force_law.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();
constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();

ForceProfile profile_of(ForceLaw law, double sharpness) {
  return {.law = law,
          .cutoff = 0.010,
          .saturation_distance = 0.002,
          .maximum_force = 6.0,
          .sharpness = sharpness};
}

TEST(ForceLaw, LinearIsProportionalToWhatIsLeftOfTheCutoff) {
  const ForceProfile profile = profile_of(ForceLaw::LINEAR, 4.0);
  EXPECT_DOUBLE_EQ(force_magnitude(profile, 0.006), 3.0);
  EXPECT_DOUBLE_EQ(force_magnitude(profile, 0.008), 1.5);
  EXPECT_DOUBLE_EQ(force_stiffness(profile, 0.006), 750.0);
}

TEST(ForceLaw, ExponentialTakesTheValuesOfItsFormula) {
  // k = ln 9: (9^(1/2) - 1) / (9 - 1) = 1/4 half way; slope F_max k 9^(1/2) / (8 * 0.008).
  const ForceProfile profile = profile_of(ForceLaw::EXPONENTIAL, std::log(9.0));
  EXPECT_NEAR(force_magnitude(profile, 0.006), 1.5, 1e-14);
  EXPECT_NEAR(force_stiffness(profile, 0.006), 6.0 * std::log(9.0) * 3.0 / 0.064, 1e-11);
}

TEST(ForceLaw, SaturatesAndEndsContinuously) {
  for (const ForceLaw law : {ForceLaw::LINEAR, ForceLaw::EXPONENTIAL}) {
    const ForceProfile profile = profile_of(law, 4.0);
    EXPECT_EQ(force_magnitude(profile, 0.0), 6.0);
    EXPECT_EQ(force_magnitude(profile, 0.002), 6.0);
    EXPECT_NEAR(force_magnitude(profile, std::nextafter(0.002, 1.0)), 6.0, 1e-13);
    EXPECT_NEAR(force_magnitude(profile, std::nextafter(0.010, 0.0)), 0.0, 1e-13);
    EXPECT_GT(force_magnitude(profile, std::nextafter(0.010, 0.0)), 0.0);
    EXPECT_EQ(force_magnitude(profile, 0.010), 0.0);
    for (const double beyond : {0.0101, 0.015, 0.0199, 1.0})
      EXPECT_EQ(force_magnitude(profile, beyond), 0.0) << beyond;
    EXPECT_EQ(force_stiffness(profile, 0.002), 0.0);
    EXPECT_EQ(force_stiffness(profile, 0.010), 0.0);
    EXPECT_GT(force_stiffness(profile, 0.005), 0.0);
  }
}

TEST(ForceLaw, OneWithoutADescriptionIsNoOther) {
  EXPECT_EQ(force_laws().size(), FORCE_LAW_COUNT);
  EXPECT_DEATH(force_magnitude(profile_of(static_cast<ForceLaw>(FORCE_LAW_COUNT), 4.0), 0.005),
               "a force law without a description");
}

TEST(ForceLaw, SmallSharpnessTendsToLinearWithEveryDigit) {
  const ForceProfile linear = profile_of(ForceLaw::LINEAR, 0.0);
  for (const double k : {0.0, 1e-300, 1e-17, 1e-12, 1e-9}) {
    const ForceProfile profile = profile_of(ForceLaw::EXPONENTIAL, k);
    for (const double d : {0.0021, 0.004, 0.0099, 0.00999999}) {
      // (e^(ks) - 1)/(e^k - 1) = s (1 - k (1 - s)/2 + O(k^2))
      const double s = (0.010 - d) / 0.008;
      const double expected = force_magnitude(linear, d) * (1.0 - k * (1.0 - s) / 2.0);
      EXPECT_NEAR(force_magnitude(profile, d) / expected, 1.0, 1e-15) << k << " " << d;
      const double expected_slope = force_stiffness(linear, d) * (1.0 + k * (s - 0.5));
      EXPECT_NEAR(force_stiffness(profile, d) / expected_slope, 1.0, 1e-15) << k << " " << d;
    }
  }
}

TEST(ForceLaw, HugeSharpnessNeitherOverflowsNorTurnsNan) {
  for (const double k : {700.0, 1e4, 1e300}) {
    const ForceProfile profile = profile_of(ForceLaw::EXPONENTIAL, k);
    for (const double d : {0.002, 0.0020001, 0.006, 0.0099, 0.010}) {
      const double force = force_magnitude(profile, d);
      EXPECT_TRUE(std::isfinite(force) && force >= 0.0 && force <= 6.0) << k << " " << d;
      EXPECT_TRUE(std::isfinite(force_stiffness(profile, d))) << k << " " << d;
    }
  }
  // e^(k (s - 1)) to rounding where e^-k has vanished.
  const ForceProfile profile = profile_of(ForceLaw::EXPONENTIAL, 700.0);
  EXPECT_NEAR(force_magnitude(profile, 0.003) / (6.0 * std::exp(700.0 * (0.007 / 0.008 - 1.0))), 1.0, 1e-12);
}

TEST(ForceLaw, StiffnessIsTheSlopeOfTheForce) {
  for (const ForceLaw law : {ForceLaw::LINEAR, ForceLaw::EXPONENTIAL}) {
    for (const double k : {0.01, 1.0, 4.0, 30.0}) {
      const ForceProfile profile = profile_of(law, k);
      for (const double d : {0.003, 0.005, 0.009}) {
        const double h = 1e-7;
        const double slope = (force_magnitude(profile, d - h) - force_magnitude(profile, d + h)) / (2.0 * h);
        EXPECT_NEAR(force_stiffness(profile, d), slope, 1e-6 * std::max(slope, 1.0)) << k << " " << d;
      }
    }
  }
}

TEST(ForceLaw, ForceFallsWithDistance) {
  const ForceProfile profile = profile_of(ForceLaw::EXPONENTIAL, 8.0);
  double previous = INFINITE;
  for (int i = 0; i <= 1200; ++i) {
    const double force = force_magnitude(profile, i * 1e-5);
    EXPECT_LE(force, previous) << i;
    previous = force;
  }
}

TEST(ForceLaw, UnsetDistanceStaysVisible) {
  EXPECT_TRUE(std::isnan(force_magnitude(profile_of(ForceLaw::LINEAR, 1.0), NAN_VALUE)));
  EXPECT_TRUE(std::isnan(force_stiffness(profile_of(ForceLaw::EXPONENTIAL, 1.0), NAN_VALUE)));
}

std::string complaint_about(const ForceProfile& profile) {
  return testing::complaint_of<UsageError>(
      [&] { validate_force_profile(profile, "hard.json", "/force/improved"); });
}

TEST(ForceProfile, ValidationNamesTheField) {
  using ::testing::HasSubstr;
  const ForceProfile good = profile_of(ForceLaw::EXPONENTIAL, 4.0);
  EXPECT_EQ(complaint_about(good), "");
  for (const double bad : {0.0, -1.0, NAN_VALUE, INFINITE}) {
    ForceProfile profile = good;
    profile.cutoff = bad;
    EXPECT_THAT(complaint_about(profile), HasSubstr("hard.json: /force/improved/cutoff: ")) << bad;
    profile = good;
    profile.maximum_force = bad;
    EXPECT_THAT(complaint_about(profile), HasSubstr("/force/improved/maximum_force: ")) << bad;
  }
  for (const double bad : {-1e-9, 0.010, 0.011, NAN_VALUE}) {
    ForceProfile profile = good;
    profile.saturation_distance = bad;
    EXPECT_THAT(complaint_about(profile), HasSubstr("/force/improved/saturation_distance: ")) << bad;
  }
  for (const double bad : {-1e-9, NAN_VALUE, INFINITE}) {
    ForceProfile profile = good;
    profile.sharpness = bad;
    EXPECT_THAT(complaint_about(profile), HasSubstr("/force/improved/sharpness: ")) << bad;
  }
  ForceProfile edge = good;
  edge.saturation_distance = 0.0;
  edge.sharpness = 0.0;
  EXPECT_EQ(complaint_about(edge), "");
}

}  // namespace
}  // namespace lmdbench
