// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/cleanliness.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

/// 45 cycles of a swing whose amplitude grows by a rate per cycle; 50 Hz at 1 kHz.
Swing swing(double rate, double force = 1.0, double hertz = 50.0) {
  Swing result;
  const double cycle = 1000.0 / hertz;
  for (int n = 0; n < static_cast<int>(45 * cycle); ++n) {
    const double angle = 2.0 * std::numbers::pi * n / cycle;
    const double size = std::exp(rate * n / cycle);
    result.position_W.push_back(Vec3(1e-3 + 1e-4 * size * std::sin(angle), 0.0, 0.0));
    result.velocity_W.push_back(Vec3(1e-4 * size * std::cos(angle), 0.0, 0.0));
    result.force_W.push_back(Vec3(force * size * std::sin(angle), 0.0, 0.0));
  }
  return result;
}

TEST(Cleanliness, GrowthIsMeasuredToAMillionth) {
  // The windows' centres lie WINDOW_CYCLES cycles apart.
  for (const double rate : {-1e-3, -1e-5, 1e-5, 1e-3}) {
    const Cleanliness judged = judge(swing(rate));
    EXPECT_NEAR(judged.growth, rate * WINDOW_CYCLES, 1e-6 + 1e-3 * std::abs(rate)) << rate;
    EXPECT_EQ(judged.clean(), rate < 0.0);
  }
}

TEST(Cleanliness, TellsAmplitudeAndFrequency) {
  const Cleanliness judged = judge(swing(0.0));
  EXPECT_NEAR(judge(swing(0.0, 1.0, 47.3)).frequency_hz, 47.3, 0.01) << "no whole number of frames or cycles";
  EXPECT_NEAR(judged.amplitude_m, 1e-4 / std::numbers::sqrt2, 1e-8) << "the mean place does not count";
}

TEST(Cleanliness, ADeviceThatStopsWhereItTurnsBackSwingsAsOften) {
  Swing sticking = swing(0.0);
  for (Vec3& velocity : sticking.velocity_W)
    if (std::abs(velocity.x()) < 3e-5) velocity.setZero();
  EXPECT_NEAR(judge(sticking).frequency_hz, 50.0, 0.5);
}

TEST(Cleanliness, BuzzingForceAloneIsUnclean) {
  Swing buzzing = swing(-0.01);
  for (std::size_t n = 0; n < buzzing.force_W.size(); ++n)
    buzzing.force_W[n].z() = 5.0 * std::exp(0.001 * static_cast<double>(n)) * (n % 4 < 2 ? 1.0 : -1.0);
  const Cleanliness judged = judge(buzzing);
  EXPECT_FALSE(judged.clean());
  EXPECT_EQ(judged.fastest, CleanMeasure::FORCE_ABOVE_30_HZ);
}

TEST(Cleanliness, SlowForceDoesNotCountAsBuzzing) {
  Swing pushed = swing(-0.01);
  for (std::size_t n = 0; n < pushed.force_W.size(); ++n)
    pushed.force_W[n].z() = 1e-3 * static_cast<double>(n);  // a growing, slow push
  EXPECT_TRUE(judge(pushed).clean());
}

TEST(Cleanliness, SwingWithinTheEncodersResolutionIsClean) {
  Swing growing = swing(1e-3);
  EXPECT_FALSE(judge(growing).clean());
  growing.resolution_m = 1e-3;
  EXPECT_TRUE(judge(growing).clean());
}

}  // namespace
}  // namespace lmdbench
