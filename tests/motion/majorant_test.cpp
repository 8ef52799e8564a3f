// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/majorant.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lmdbench {
namespace {

constexpr double STEP = 0.001;
constexpr MotionLimits LIMITS = {.speed = 0.15, .acceleration = 2.0};
constexpr double ROUNDING = 1e-13;

void expect_within_limits(const std::vector<double>& values, const MotionLimits& limits) {
  for (std::size_t i = 1; i < values.size(); ++i)
    EXPECT_LE(std::abs(values[i] - values[i - 1]) / STEP, limits.speed + limits.acceleration * STEP + 1e-9)
        << i;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    EXPECT_LE(std::abs(values[i + 1] - 2.0 * values[i] + values[i - 1]),
              limits.acceleration * STEP * STEP + ROUNDING)
        << i;
}

void expect_above(const std::vector<double>& values, const std::vector<double>& samples) {
  ASSERT_EQ(values.size(), samples.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_GE(values[i], samples[i]) << i;
}

TEST(BoundedMajorant, AddsNothingToSteadyMotion) {
  std::vector<double> samples;
  for (int i = 0; i < 2000; ++i) samples.push_back(0.1 + 0.02 * i * STEP);
  const std::vector<double> majorant = bounded_majorant(samples, STEP, LIMITS);
  for (std::size_t i = 100; i < samples.size() - 100; ++i)
    EXPECT_NEAR(majorant[i], samples[i], ROUNDING) << i;
}

TEST(BoundedMajorant, AddsLittleToMotionWithinTheLimits) {
  std::vector<double> samples;
  for (int i = 0; i < 2000; ++i)
    samples.push_back(0.1 + 0.003 * std::sin(10.0 * i * STEP));  // 30 mm/s, 0.3 m/s^2
  const std::vector<double> majorant = bounded_majorant(samples, STEP, LIMITS);
  expect_above(majorant, samples);
  // A single pass would add v^2/(2a) = 0.2 mm.
  for (std::size_t i = 100; i < samples.size() - 100; ++i) EXPECT_LT(majorant[i] - samples[i], 2e-6) << i;
}

TEST(BoundedMajorant, SpikeIsMetByACap) {
  std::vector<double> samples(2001, 0.0);
  samples[1000] = 0.05;
  const std::vector<double> majorant = bounded_majorant(samples, STEP, LIMITS);
  expect_above(majorant, samples);
  expect_within_limits(majorant, LIMITS);
  EXPECT_NEAR(majorant[1000], 0.05, ROUNDING);
  EXPECT_NEAR(majorant[1030], 0.05 - 0.5 * 2.0 * 0.030 * 0.030, ROUNDING);  // full braking
  EXPECT_LT(majorant[300], 1e-4);
  EXPECT_LT(majorant[1700], 1e-4);
}

TEST(BoundedMajorant, CornerIsRoundedFromAboveByLittle) {
  // No curve of acceleration a is lower than s^2/(2a) above a corner between slopes -s and s.
  const double slope = 0.02;
  std::vector<double> samples;
  for (int i = -1000; i <= 1000; ++i) samples.push_back(slope * std::abs(i) * STEP);
  const std::vector<double> majorant = bounded_majorant(samples, STEP, LIMITS);
  expect_above(majorant, samples);
  expect_within_limits(majorant, LIMITS);
  const double least = slope * slope / (2.0 * LIMITS.acceleration);
  EXPECT_GE(majorant[1000], least - 1e-7);
  EXPECT_LE(majorant[1000], 1.5 * least);
  EXPECT_NEAR(majorant[1100], samples[1100], 1e-6);
  EXPECT_NEAR(majorant[900], samples[900], 1e-6);
}

TEST(BoundedMajorant, KeepsTheLimitsAboveRoughAndJumpingSamples) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<double> samples;
    double level = 0.1;
    for (int i = 0; i < 1500; ++i) {
      if (uniform(generator) < 0.01) level = 0.08 + 0.04 * uniform(generator);
      samples.push_back(level + 0.0005 * uniform(generator));
    }
    const MotionLimits limits = {.speed = 0.02 + 0.3 * uniform(generator),
                                 .acceleration = 0.2 + 5.0 * uniform(generator)};
    const std::vector<double> majorant = bounded_majorant(samples, STEP, limits);
    SCOPED_TRACE(seed);
    expect_above(majorant, samples);
    expect_within_limits(majorant, limits);
    EXPECT_LE(*std::max_element(majorant.begin(), majorant.end()),
              *std::max_element(samples.begin(), samples.end()) + ROUNDING);
  }
}

/// A cap hardly falls along the whole path, so no cap rules out another one early. A search for the
/// highest cap at every sample would take the square of the number of samples.
TEST(BoundedMajorant, CapsAsWideAsALongPath) {
  std::vector<double> samples(500'000, 0.0);
  samples[300'000] = 1.0;
  const std::vector<double> majorant = bounded_majorant(samples, STEP, {.speed = 1e-6, .acceleration = 1e-6});
  expect_above(majorant, samples);
  EXPECT_NEAR(majorant.front(), 1.0 - 300 * 1e-6, 1e-6);
  EXPECT_NEAR(majorant.back(), 1.0 - 200 * 1e-6, 1e-6);
  EXPECT_TRUE(std::is_sorted(majorant.begin(), majorant.begin() + 300'000));
}

TEST(BoundedMajorant, NothingAndOneSample) {
  EXPECT_TRUE(bounded_majorant({}, STEP, LIMITS).empty());
  EXPECT_EQ(bounded_majorant({0.3}, STEP, LIMITS), std::vector<double>{0.3});
}

}  // namespace
}  // namespace lmdbench
