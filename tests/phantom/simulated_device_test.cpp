// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/exact_integrator.h>
#include <lmdbench/phantom/simulated_device.h>

#include <boost/numeric/odeint.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <support/message_of.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

const Vec3 NOWHERE = Vec3::Zero();

SimulatedDevice device(const DeviceDynamics& dynamics, const Vec3& push = NOWHERE, double period = 1e-3) {
  return {dynamics, period, NOWHERE, push, 0.0};
}

TEST(SimulatedDevice, FreeDeviceFollowsTheClosedForm) {
  // m v' = P - b v from rest: v = P/b (1 - e^(-b t / m)), x = P/b (t - m/b (1 - e^(-b t / m))).
  SimulatedDevice free = device({0.04, 0.8, 0.0, std::nullopt}, Vec3(0.5, -0.25, 0.0));
  for (int n = 0; n < 500; ++n) free.advance(NOWHERE, NOWHERE);
  const double share = -std::expm1(-0.8 * 0.5 / 0.04);
  EXPECT_NEAR(free.velocity().x(), 0.5 / 0.8 * share, 1e-13);
  EXPECT_NEAR(free.position().x(), 0.5 / 0.8 * (0.5 - 0.05 * share), 1e-13);
  EXPECT_NEAR(free.position().y(), -0.5 * free.position().x(), 1e-14);
  EXPECT_EQ(free.position().z(), 0.0);
}

TEST(SimulatedDevice, RenderedForceIsHeldForOnePeriod) {
  SimulatedDevice once = device({0.1, 0.0, 0.0, std::nullopt});
  once.advance(Vec3(2.0, 0.0, 0.0), NOWHERE);
  EXPECT_NEAR(once.velocity().x(), 2.0 / 0.1 * 1e-3, 1e-16);
  EXPECT_NEAR(once.position().x(), 0.5 * 2.0 / 0.1 * 1e-6, 1e-18);
  once.advance(NOWHERE, NOWHERE);
  EXPECT_NEAR(once.velocity().x(), 2.0 / 0.1 * 1e-3, 1e-16);
  EXPECT_NEAR(once.energy().rendered, 2.0 * 1e-5, 1e-18);
}

TEST(SimulatedDevice, HandDrawsTheDeviceAlongThePath) {
  const Hand hand{"custom", 0.5, 6.0, 500.0, 0.0, 0.0};
  SimulatedDevice drawn = device({0.05, 0.2, 0.0, hand});
  for (int n = 1; n <= 4000; ++n) drawn.advance(NOWHERE, Vec3(0.02 * n * 1e-3, 0.0, 0.0));
  // In steady motion it lags by b u / k: the device's damper acts against the ground.
  EXPECT_NEAR(drawn.velocity().x(), 0.02, 1e-9);
  EXPECT_NEAR(drawn.position().x(), 0.08 - 0.2 * 0.02 / 500.0, 1e-9);
}

TEST(SimulatedDevice, GripStretchesUnderTheForce) {
  const Hand hand{"custom", 1.0, 8.0, 100.0, 8.0, 400.0};
  SimulatedDevice gripped = device({0.05, 0.1, 0.0, hand});
  for (int n = 0; n < 20000; ++n) gripped.advance(Vec3(1.0, 0.0, 0.0), NOWHERE);
  EXPECT_NEAR(gripped.position().x(), 1.0 / 100.0 + 1.0 / 400.0, 1e-9);
}

TEST(SimulatedDevice, FrictionHoldsWhatIsTooWeak) {
  SimulatedDevice held = device({0.04, 0.1, 0.06, std::nullopt}, Vec3(0.0599, -0.05999, 0.0601));
  for (int n = 0; n < 100; ++n) held.advance(NOWHERE, NOWHERE);
  EXPECT_EQ(held.position().x(), 0.0);
  EXPECT_EQ(held.position().y(), 0.0);
  EXPECT_GT(held.position().z(), 0.0);
}

TEST(SimulatedDevice, FrictionStopsASlidingDeviceWhereItShould) {
  // Without damping it slides v^2 m / (2 f) far, and stops inside a period, not at its end.
  const double speed = 0.123;
  SimulatedDevice sliding = device({0.04, 0.0, 0.05, std::nullopt});
  sliding.strike(Vec3(speed, 0.0, 0.0));
  for (int n = 0; n < 200; ++n) sliding.advance(NOWHERE, NOWHERE);
  EXPECT_EQ(sliding.velocity().x(), 0.0);
  EXPECT_NEAR(sliding.position().x(), speed * speed * 0.04 / (2.0 * 0.05), 1e-13);
  EXPECT_NEAR(sliding.energy().friction, 0.5 * 0.04 * speed * speed, 1e-15);
  EXPECT_NEAR(sliding.energy().push, 0.5 * 0.04 * speed * speed, 1e-15) << "the blow's work";
  EXPECT_LE(sliding.energy().balance_error(), 1e-12);
}

TEST(SimulatedDevice, StuckDeviceLetsGoWhenTheHandHasPulledEnough) {
  const Hand hand{"custom", 0.0, 0.0, 100.0, 0.0, 0.0};
  SimulatedDevice pulled = device({0.04, 0.0, 0.05, hand});
  // The path moves at 0.1 m/s: the spring's force reaches 0.05 N after 5 ms.
  for (int n = 1; n <= 5; ++n) pulled.advance(NOWHERE, Vec3(0.1 * n * 1e-3, 0.0, 0.0));
  EXPECT_NEAR(pulled.position().x(), 0.0, 1e-15);
  pulled.advance(NOWHERE, Vec3(0.1 * 6e-3, 0.0, 0.0));
  // Then m x'' = k u t - k x: x = u (t - sin(w t) / w).
  const double w = std::sqrt(100.0 / 0.04);
  EXPECT_NEAR(pulled.position().x(), 0.1 * (1e-3 - std::sin(w * 1e-3) / w), 1e-12);
}

TEST(SimulatedDevice, OscillatorLosesTwoFrictionDeflectionsEveryHalfTurn) {
  // Known result: each half oscillation is shorter by 2 f / k than the one before.
  const Hand spring{"custom", 0.0, 0.0, 1000.0, 0.0, 0.0};
  SimulatedDevice swinging = device({0.04, 0.0, 0.05, spring}, NOWHERE, 1.7e-3);
  const double w = std::sqrt(1000.0 / 0.04);
  swinging.strike(Vec3(0.5, 0.0, 0.0));
  double first_peak = 0.0;
  double second_peak = 0.0;
  for (int n = 0; n * 1.7e-3 < 2.4 * std::numbers::pi / w; ++n) swinging.advance(NOWHERE, NOWHERE);
  // Started with speed v at the rest position; for its peak p, k p^2/2 + f p = m v^2/2.
  first_peak = (-0.05 + std::sqrt(0.05 * 0.05 + 1000.0 * 0.04 * 0.25)) / 1000.0;
  second_peak = first_peak - 2.0 * 0.05 / 1000.0;
  const EnergyAccount energy = swinging.energy();
  // It has slid to the first peak, to the second one beyond rest, and a part of the way back.
  const double slid = energy.friction / 0.05;
  EXPECT_NEAR(0.5 * 0.04 * 0.25, energy.kinetic + energy.spring + energy.friction, 1e-15);
  EXPECT_NEAR(swinging.position().x(), slid - 2.0 * first_peak - 2.0 * second_peak, 1e-12)
      << "it turned at both peaks";
}

TEST(SimulatedDevice, SensesWholeCounts) {
  SimulatedDevice coarse({0.04, 0.8, 0.0, std::nullopt}, 1e-3, Vec3(1e-4, -1e-4, 7e-5), NOWHERE, 3e-5);
  EXPECT_NEAR(coarse.sensed_position().x(), 9e-5, 1e-18);
  EXPECT_NEAR(coarse.sensed_position().y(), -9e-5, 1e-18);
  EXPECT_NEAR(coarse.sensed_position().z(), 6e-5, 1e-18);
  EXPECT_EQ(coarse.position().x(), 1e-4);
}

/// For a random device, hand and force, energy in is energy held plus energy lost.
RC_GTEST_PROP(SimulatedDevice, EnergyBalanceCloses, ()) {
  const auto number = [](double least, double most) {
    return least * std::pow(most / least, *rc::gen::inRange(0, 1000001) / 1e6);
  };
  const auto component = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  DeviceDynamics dynamics{number(0.01, 1.0), number(0.01, 10.0), 0.0, std::nullopt};
  if (*rc::gen::arbitrary<bool>()) dynamics.friction_n = number(0.01, 0.5);
  if (*rc::gen::arbitrary<bool>()) {
    dynamics.hand = Hand{"custom", number(0.1, 3.0), number(0.5, 20.0), number(10.0, 1000.0), 0.0, 0.0};
    if (*rc::gen::arbitrary<bool>()) {
      dynamics.hand->grip_damping_n_s_per_m = number(1.0, 20.0);
      dynamics.hand->grip_stiffness_n_per_m = number(100.0, 2000.0);
    }
  }
  const Vec3 rest(0.3, -0.2, 10.0);
  const double period = 1.0 / number(250.0, 10000.0);
  SimulatedDevice simulated(dynamics, period, rest, Vec3(component(), component(), component()), 0.0);
  const double stiffness = number(1.0, 2000.0);
  const Vec3 speed(0.1 * component(), 0.1 * component(), 0.1 * component());
  for (int n = 0; n < 1000; ++n) {
    const Vec3 force = -stiffness * (simulated.position() - rest);
    const double limit = std::max(1.0, force.norm());
    simulated.advance(force / limit * 3.0, rest + n * period * speed * std::sin(0.01 * n));
  }
  // If friction nearly holds the device, rounding of positions exceeds the energy that it moves.
  RC_PRE(simulated.energy().moved > 1e-4);
  RC_ASSERT(simulated.energy().balance_error() <= 1e-12);
  RC_ASSERT(simulated.energy().damped >= 0.0);
  RC_ASSERT(simulated.energy().friction >= 0.0);
}

/// An axis by Boost.odeint's Dormand-Prince; friction smoothed to f tanh(v / 0.1 mm/s), no events.
void advance_smoothed(const AxisModel& model, double period, AxisState& state) {
  namespace odeint = boost::numeric::odeint;
  using Vector = std::array<double, AXIS_STATE_SIZE>;
  const auto rates = [&](const Vector& x, Vector& result, double) {
    AxisState with_friction = Eigen::Map<const AxisState>(x.data());
    at(with_friction, AxisSlot::FRICTION_FORCE) =
        -model.friction_n * std::tanh(at(with_friction, AxisSlot::VELOCITY) / 1e-4);
    Eigen::Map<AxisState>(result.data()) = model.slipping * with_friction;
  };
  Vector x{};
  std::copy(state.begin(), state.end(), x.begin());
  odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_dopri5<Vector>>(1e-9, 1e-9), rates,
                             x, 0.0, period, period);
  state = Eigen::Map<const AxisState>(x.data());
}

TEST(ExactIntegrator, AgreesWithOdeint) {
  const AxisModel model = make_axis_model({0.05, 0.8, 0.0, Hand{"custom", 0.5, 6.0, 500.0, 8.0, 400.0}});
  ExactIntegrator integrator(model, 1e-3);
  AxisState exact = AxisState::Zero(), other = exact;
  EnergyFlows flows = EnergyFlows::Zero();
  for (int n = 1; n <= 300; ++n) {
    for (AxisState* state : {&exact, &other}) {
      at(*state, AxisSlot::RENDERED_FORCE) = -800.0 * at(*state, AxisSlot::POSITION);
      at(*state, AxisSlot::PUSH) = 0.3;
      at(*state, AxisSlot::PATH_VELOCITY) = 1e-2;
    }
    integrator.advance(exact, flows);
    advance_smoothed(model, 1e-3, other);
  }
  EXPECT_GT(std::abs(at(exact, AxisSlot::POSITION)), 1e-4);
  EXPECT_LT((other - exact).norm(), 1e-7);
  EXPECT_GT((other - exact).norm(), 0.0);
}

TEST(ExactIntegrator, ComesNearASmoothedFriction) {
  const AxisModel model = make_axis_model({0.05, 0.1, 0.05, std::nullopt});
  ExactIntegrator integrator(model, 1e-3);
  AxisState exact = AxisState::Zero();
  at(exact, AxisSlot::VELOCITY) = 0.1;
  AxisState other = exact;
  EnergyFlows flows = EnergyFlows::Zero();
  for (int n = 0; n < 300; ++n) {
    integrator.advance(exact, flows);
    advance_smoothed(model, 1e-3, other);
  }
  EXPECT_GT(at(exact, AxisSlot::POSITION), 1e-3);
  EXPECT_NEAR(at(other, AxisSlot::POSITION), at(exact, AxisSlot::POSITION),
              0.01 * at(exact, AxisSlot::POSITION));
}

TEST(SimulatedDevice, NamesTheFigureAtFault) {
  const auto make = [] { device({0.05, 0.1, -0.05, std::nullopt}); };
  EXPECT_THAT(testing::message_of<UsageError>(make), ::testing::HasSubstr("friction_n"));
}

TEST(Hands, AreKnownByName) {
  EXPECT_DOUBLE_EQ(hand_named("postural-arm").stiffness_n_per_m, 135.0);
  EXPECT_TRUE(hand_named("speich-2005").has_grip());
  EXPECT_THROW(hand_named("none-such", "wall.json", "/loop/hand"), UsageError);
}

}  // namespace
}  // namespace lmdbench
