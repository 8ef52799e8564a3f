// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/passivity.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lmdbench {
namespace {

double within(double least, double most, int percent) {
  return least + (most - least) * percent / 100.0;
}

/// Colgate's condition K <= 2 b / T: whatever the hand does, no frame gains net energy.
RC_GTEST_PROP(Passivity, WallWithinColgatesConditionNeverGivesEnergy, ()) {
  const double period = *rc::gen::element(1e-4, 1e-3, 4e-3);
  const double damping = within(0.1, 5.0, *rc::gen::inRange(0, 101));
  const SampledWall wall{2.0 * damping / period * within(0.05, 1.0, *rc::gen::inRange(0, 101)), period, 0.0};
  // The hand has no damper: only the device damps.
  const Hand hand{"pulls", within(0.0, 1.0, *rc::gen::inRange(0, 101)),
                  0.0,     within(10.0, 2000.0, *rc::gen::inRange(0, 101)),
                  0.0,     0.0};
  SimulatedDevice device({0.05, damping, 0.0, hand}, period, Vec3::Zero(), Vec3::Zero(), 0.0);
  const std::vector<int> pulls = *rc::gen::container<std::vector<int>>(200, rc::gen::inRange(-20, 21));
  double path = 0.0;
  for (const int pull : pulls) {
    path = std::clamp(path + 1e-5 * pull, -1e-2, 1e-2);
    device.advance(Vec3(wall_force(wall, device.sensed_position().x()), 0.0, 0.0), Vec3(path, 0.0, 0.0));
    const EnergyAccount energy = device.energy();
    RC_ASSERT(energy.rendered - energy.damped <= 1e-12 * energy.moved);
    RC_ASSERT(energy.balance_error() <= 1e-12);
  }
}

/// Above the condition and below it, the energy of each period is as in theory.
RC_GTEST_PROP(Passivity, GainOfSteadyMotionIsTheorys, ()) {
  const double period = *rc::gen::element(1e-4, 1e-3, 4e-3);
  const double damping = within(0.1, 5.0, *rc::gen::inRange(0, 101));
  const double stiffness = 2.0 * damping / period * within(0.0, 4.0, *rc::gen::inRange(1, 101));
  const double way = within(1e-6, 1e-3, *rc::gen::inRange(0, 101));
  const int depth = *rc::gen::inRange(2, 60);
  const Excursion excursion = carry_through({stiffness, period, 0.0}, damping, 0.0, way, depth);
  RC_ASSERT(excursion.periods == 2 * depth + 1);
  const double theory =
      (0.5 * stiffness - damping / period) * way * way * static_cast<double>(excursion.periods);
  const double scale = (stiffness + damping / period) * way * way * depth;
  RC_ASSERT(std::abs(excursion.net_energy_j - theory) <= 1e-6 * scale);
}

TEST(Passivity, ColgatesConditionIsSharp) {
  const auto net = [](double ratio) {
    return carry_through({ratio * 1600.0, 1e-3, 0.0}, 0.8, 0.0, 1e-4, 400).net_energy_j;
  };
  EXPECT_LT(net(0.99), 0.0);
  EXPECT_GT(net(1.01), 0.0);
}

TEST(Passivity, FrictionTakesItsForceTimesTheWay) {
  const double without = carry_through({3200.0, 1e-3, 0.0}, 0.8, 0.0, 1e-4, 50).net_energy_j;
  const double with = carry_through({3200.0, 1e-3, 0.0}, 0.8, 0.03, 1e-4, 50).net_energy_j;
  EXPECT_NEAR(without - with, 0.03 * 101 * 1e-4, 1e-9);
}

/// Diolaiti et al. 2006: friction of half a count's force stops the oscillation between two counts.
TEST(Passivity, FrictionOfHalfACountsForceEndsLimitCycles) {
  const SampledWall wall{800.0, 1e-3, 2.3e-5};
  const double enough = 0.5 * wall.stiffness_n_per_m * wall.resolution_m;
  const auto swing = [&](double friction) {
    return rest_on(wall, {0.04, 0.8, friction, std::nullopt},
                   20.5 * wall.stiffness_n_per_m * wall.resolution_m, 0.01, 20000);
  };
  EXPECT_GT(swing(0.0).frequency_hz, 1.0) << "no count's force balances the load";
  EXPECT_GT(swing(0.0).amplitude_m, 0.01 * wall.resolution_m);
  EXPECT_LT(swing(0.0).amplitude_m, 4.0 * wall.resolution_m);
  EXPECT_EQ(swing(1.01 * enough).frequency_hz, 0.0);
  EXPECT_EQ(swing(1.01 * enough).amplitude_m, 0.0);
}

}  // namespace
}  // namespace lmdbench
