// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/stability_boundary.h>

#include <gtest/gtest.h>
#include <phantom/closed_form.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace lmdbench {
namespace {

SampledLoop loop(double mass, double damping, double period, std::int64_t delay) {
  return {{mass, damping, 0.0, std::nullopt}, period, delay};
}

/// As published, and derived in two ways: mass 0.04 kg, damping 0.8 N s/m, 1 kHz.
TEST(StabilityBoundary, MatchesThePublishedTable) {
  const std::pair<std::int64_t, double> table[] = {{0, 1605.3511}, {1, 536.2786}, {2, 322.7439},
                                                   {5, 148.0801},  {10, 78.7445}, {50, 17.9961},
                                                   {100, 9.7415}};
  for (const auto& [delay, expected] : table)
    EXPECT_NEAR(critical_stiffness(loop(0.04, 0.8, 1e-3, delay)), expected, 5.1e-5) << delay;
}

/// Devices and rates from 250 Hz to 10 kHz, beyond the range of real ones.
struct AnyLoop {
  double mass = 0.0;
  double damping = 0.0;
  double period = 0.0;
};

double logarithmic(double least, double most) {
  const double share = *rc::gen::inRange(0, 1000001) / 1e6;
  return least * std::pow(most / least, share);
}

AnyLoop any_loop() {
  return {logarithmic(0.01, 5.0), logarithmic(0.05, 20.0), 1.0 / logarithmic(250.0, 10000.0)};
}

RC_GTEST_PROP(StabilityBoundary, ClosedFormWithoutDelay, ()) {
  const AnyLoop any = any_loop();
  const double expected = critical_stiffness_without_delay(any.mass, any.damping, any.period);
  const double found = critical_stiffness(loop(any.mass, any.damping, any.period, 0));
  RC_ASSERT(std::abs(found / expected - 1.0) < 1e-7);
}

/// Damping that stops the device within a frame, b T / m > 4: it shakes at an eigenvalue of -1.
RC_GTEST_PROP(StabilityBoundary, StrongDampingShakesAtHalfTheRate, ()) {
  const double damping = logarithmic(1.0, 20.0), period = 1.0 / logarithmic(250.0, 10000.0);
  const double mass = damping * period / logarithmic(4.5, 30.0);
  const double critical = critical_stiffness(loop(mass, damping, period, 0));
  RC_ASSERT(std::abs(critical / critical_stiffness_without_delay(mass, damping, period) - 1.0) < 1e-7);
  RC_ASSERT(spectral_radius(loop(mass, damping, period, 0), critical * 0.999) < 1.0);
  RC_ASSERT(spectral_radius(loop(mass, damping, period, 0), critical * 1.001) > 1.0);
}

RC_GTEST_PROP(StabilityBoundary, EigenvaluesLeaveTheCircleThere, ()) {
  const AnyLoop any = any_loop();
  const SampledLoop sampled = loop(any.mass, any.damping, any.period, *rc::gen::inRange(0, 51));
  const double critical = critical_stiffness(sampled);
  RC_ASSERT(spectral_radius(sampled, critical * 0.999) < 1.0);
  RC_ASSERT(spectral_radius(sampled, critical * 1.001) > 1.0);
}

TEST(StabilityBoundary, ADamperOfAGripWithoutASpringIsNone) {
  SampledLoop undamped = loop(0.04, 0.0, 1e-3, 0);
  undamped.dynamics.hand = Hand{"custom", 0.5, 0.0, 100.0, 5.0, 0.0};
  EXPECT_EQ(critical_stiffness(undamped), 0.0) << "the hand is rigidly attached";
}

TEST(StabilityBoundary, EveryKnownHandIsOnTheBoundary) {
  for (const KnownHand& known : known_hands()) {
    for (const std::int64_t delay : {0, 1, 7}) {
      const SampledLoop sampled{{0.072, 0.005, 0.0, known.hand}, 1e-3, delay};
      const double critical = critical_stiffness(sampled);
      EXPECT_LT(spectral_radius(sampled, critical * 0.999), 1.0) << known.hand.name << " delay " << delay;
      EXPECT_GT(spectral_radius(sampled, critical * 1.001), 1.0) << known.hand.name << " delay " << delay;
    }
  }
}

/// Independently computed values for a device of 72 g and 0.005 N s/m with three hands.
TEST(StabilityBoundary, MatchesTheTableOfHands) {
  const auto with_hand = [](const char* name, std::int64_t delay) {
    return critical_stiffness({{0.072, 0.005, 0.0, hand_named(name)}, 1e-3, delay});
  };
  EXPECT_NEAR(with_hand("postural-arm", 0), 12932.0, 0.5);
  EXPECT_NEAR(with_hand("postural-arm", 1), 4316.0, 0.5);
  EXPECT_NEAR(with_hand("postural-arm", 10), 628.0, 0.5);
  EXPECT_NEAR(with_hand("hogan-1989", 0), 11022.0, 0.5);
  EXPECT_NEAR(with_hand("hogan-1989", 5), 1010.0, 0.5);
  EXPECT_NEAR(with_hand("yokokohji-1994", 0), 4011.0, 0.5);
  EXPECT_NEAR(with_hand("yokokohji-1994", 50), 40.0, 0.5);
}

RC_GTEST_PROP(StabilityBoundary, SufficientBoundIsOnTheSafeSide, ()) {
  const AnyLoop any = any_loop();
  const SampledLoop sampled = loop(any.mass, any.damping, any.period, *rc::gen::inRange(0, 51));
  RC_ASSERT(sufficient_stiffness(sampled) <= critical_stiffness(sampled) * (1.0 + 1e-9));
}

TEST(StabilityBoundary, SufficientBoundIsThePublishedOne) {
  EXPECT_DOUBLE_EQ(sufficient_stiffness(loop(0.04, 0.8, 1e-3, 0)), 1600.0);
  EXPECT_NEAR(sufficient_stiffness(loop(0.04, 0.8, 1e-3, 50)), 15.84, 0.005);
}

/// A contact on a lever: if the mass does not move, it is a rotational wall, K l^2.
TEST(StabilityBoundary, LeverOfAHeavyDeviceIsARotationalWall) {
  SampledLoop sampled = loop(1e9, 1e5, 1e-3, 2);
  sampled.turn = SampledTurn{{1e-4, 2e-3, 0.0, std::nullopt}, 0.05};
  const double rotational = critical_stiffness(loop(1e-4, 2e-3, 1e-3, 2));
  EXPECT_NEAR(critical_stiffness(sampled), rotational / (0.05 * 0.05), 1e-6 * rotational / (0.05 * 0.05));
}

TEST(StabilityBoundary, TurnLikeTheTranslationHalvesTheBoundary) {
  SampledLoop sampled = loop(0.04, 0.8, 1e-3, 1);
  const double alone = critical_stiffness(sampled);
  sampled.turn = SampledTurn{sampled.dynamics, 1.0};
  EXPECT_NEAR(critical_stiffness(sampled), 0.5 * alone, 1e-9 * alone);
  EXPECT_NEAR(sufficient_stiffness(sampled), 0.5 * sufficient_stiffness(loop(0.04, 0.8, 1e-3, 1)), 1e-9);
  sampled.turn->lever_m = 0.0;
  EXPECT_EQ(critical_stiffness(sampled), alone);
  EXPECT_EQ(sufficient_stiffness(sampled), sufficient_stiffness(loop(0.04, 0.8, 1e-3, 1)));
}

/// Hands give every degree of freedom a spring; without one an eigenvalue stays at 1.
RC_GTEST_PROP(StabilityBoundary, EigenvaluesOfATurningDeviceLeaveTheCircleThere, ()) {
  const AnyLoop any = any_loop();
  const Hand hand{"custom", 0.1, 1.0, 100.0, 0.0, 0.0};
  SampledLoop sampled{{any.mass, any.damping, 0.0, hand}, any.period, *rc::gen::inRange(0, 21)};
  const Hand wrist{"custom", logarithmic(1e-5, 1e-3), logarithmic(1e-3, 1e-1), 1.0, 0.0, 0.0};
  sampled.turn = SampledTurn{{logarithmic(1e-5, 1e-2), 0.0, 0.0, wrist}, logarithmic(0.005, 0.2)};
  const double critical = critical_stiffness(sampled);
  RC_ASSERT(spectral_radius(sampled, critical * 0.999) < 1.0);
  RC_ASSERT(spectral_radius(sampled, critical * 1.001) > 1.0);
  RC_ASSERT(sufficient_stiffness(sampled) <= critical * (1.0 + 1e-9));
}

TEST(StabilityBoundary, NothingIsStableWithoutDamping) {
  EXPECT_EQ(critical_stiffness(loop(0.04, 0.0, 1e-3, 0)), 0.0);
  SampledLoop turning = loop(0.04, 0.8, 1e-3, 0);
  turning.turn = SampledTurn{{1e-4, 0.0, 0.0, std::nullopt}, 0.05};
  EXPECT_EQ(critical_stiffness(turning), 0.0);
}

TEST(StabilityBoundary, RefusesWhatIsNoDevice) {
  EXPECT_THROW(critical_stiffness(loop(0.0, 0.8, 1e-3, 0)), UsageError);
  EXPECT_THROW(critical_stiffness(loop(0.04, -0.1, 1e-3, 0)), UsageError);
  EXPECT_THROW(critical_stiffness(loop(0.04, 0.8, 0.0, 0)), UsageError);
  EXPECT_THROW(critical_stiffness(loop(0.04, 0.8, 1e-3, -1)), UsageError);
  EXPECT_THROW(critical_stiffness(loop(std::numeric_limits<double>::quiet_NaN(), 0.8, 1e-3, 0)), UsageError);
}

}  // namespace
}  // namespace lmdbench
