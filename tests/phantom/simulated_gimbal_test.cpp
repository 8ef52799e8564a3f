// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/rotation_vector.h>
#include <lmdbench/phantom/simulated_device.h>
#include <lmdbench/phantom/stability_boundary.h>

#include <gtest/gtest.h>
#include <phantom/closed_form.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using Eigen::Quaterniond;

const Quaterniond LEVEL = Quaterniond::Identity();
const Vec3 NOTHING = Vec3::Zero();

DeviceDynamics turning(double inertia, double damping, std::optional<Hand> hand = std::nullopt) {
  return {inertia, damping, 0.0, std::move(hand)};
}

TEST(GeneralisedTorque, DoesTheWorkOfTheTorqueAtAnyTurn) {
  const Vec3 torque(0.3, -1.2, 0.7);
  const Vec3 rate(1.1, 0.4, -0.9);
  for (const double angle : {0.0, 1e-6, 0.049, 0.051, 1.0, 3.0, 5.0}) {
    const Vec3 y = angle * Vec3(2.0, -1.0, 2.0) / 3.0;
    constexpr double STEP = 1e-6;
    const Vec3 turned =
        rotation_vector_of(rotation_of(y + STEP * rate) * rotation_of(y - STEP * rate).conjugate());
    const Vec3 angular_velocity = turned / (2.0 * STEP);
    EXPECT_NEAR(generalised_torque(y, torque).dot(rate), torque.dot(angular_velocity), 1e-8) << angle;
  }
}

TEST(SimulatedGimbal, FreeTurnFollowsTheClosedForm) {
  // Like a mass on a damper: J w' = P - b w from rest, for more than a whole turn.
  SimulatedGimbal free(turning(1e-4, 2e-3), 1e-3, LEVEL, Vec3(0.0, 0.05, 0.0), 0.0);
  for (int n = 0; n < 500; ++n) free.advance(NOTHING, LEVEL);
  const double share = -std::expm1(-2e-3 * 0.5 / 1e-4);
  EXPECT_NEAR(free.angular_velocity().y(), 25.0 * share, 1e-10);
  const double angle = 25.0 * (0.5 - 0.05 * share);
  EXPECT_NEAR(free.offset().y(), angle, 1e-10);
  EXPECT_LT(free.orientation().angularDistance(rotation_of(Vec3(0.0, angle, 0.0))), 1e-9);
}

TEST(SimulatedGimbal, HandTurnsTheDeviceAlongThePath) {
  const Hand hand{"custom", 1e-4, 0.01, 0.5, 0.0, 0.0};
  // The path starts tilted and turns about an axis of the world, not of the mesh.
  const Quaterniond tilted = rotation_of(Vec3(1.0, 2.0, -0.5));
  SimulatedGimbal drawn(turning(1e-4, 2e-3, hand), 1e-3, tilted, NOTHING, 0.0);
  for (int n = 1; n <= 4000; ++n)
    drawn.advance(NOTHING, rotation_of(Vec3(0.0, 0.0, 0.8 * n * 1e-3)) * tilted);
  // In steady motion it lags by b u / k: the device's damper acts against the ground.
  EXPECT_NEAR(drawn.offset().z(), -2e-3 * 0.8 / 0.5, 1e-9);
  const Quaterniond behind = rotation_of(Vec3(0.0, 0.0, 3.2 - 2e-3 * 0.8 / 0.5)) * tilted;
  EXPECT_LT(drawn.orientation().angularDistance(behind), 1e-7);
}

TEST(SimulatedGimbal, AngularVelocityIsThatOfItsOrientation) {
  // A stiff push far from a path that turns about a changing axis.
  const Hand hand{"custom", 1e-4, 0.01, 0.5, 0.0, 0.0};
  SimulatedGimbal gimbal(turning(1e-4, 2e-3, hand), 1e-4, LEVEL, Vec3(0.3, -0.2, 0.1), 0.0);
  const auto path = [](int n) {
    return rotation_of(Vec3(0.0, 0.0, 5e-4 * n)) * rotation_of(Vec3(3e-4 * n, 0.0, 0.0));
  };
  double furthest = 0.0;
  for (int n = 1; n <= 5000; ++n) {
    const Quaterniond before = gimbal.orientation();
    const Vec3 at_begin = gimbal.angular_velocity();
    gimbal.advance(NOTHING, path(n));
    const Vec3 mean = rotation_vector_of(gimbal.orientation() * before.conjugate()) / 1e-4;
    const Vec3 ends = 0.5 * (at_begin + gimbal.angular_velocity());
    if (n > 1) {  // in the first step the path starts at once
      EXPECT_LT((ends - mean).norm(), 1e-3 * (1.0 + ends.norm())) << n;
    }
    furthest = std::max(furthest, gimbal.offset().norm());
  }
  EXPECT_GT(furthest, 0.5);
}

/// A magnet b in a field m has the potential -m (R b). The energy that the sampled torque adds
/// vanishes with the period, through turns beyond a right angle about a changing axis.
TEST(SimulatedGimbal, ConservativeTorqueConservesEnergyAtLargeTurns) {
  const Vec3 field(0.02, 0.0, 0.01);
  const Vec3 magnet(0.0, 0.6, 0.8);
  const auto gained = [&](double period) {
    SimulatedGimbal gimbal(turning(1e-4, 0.0), period, LEVEL, NOTHING, 0.0);
    gimbal.strike(Vec3(12.0, -5.0, 3.0));
    const auto energy = [&] { return gimbal.energy().kinetic - field.dot(gimbal.orientation() * magnet); };
    const double before = energy();
    double turned = 0.0;
    for (int n = 0; n * period < 0.2; ++n) {
      gimbal.advance((gimbal.orientation() * magnet).cross(field), LEVEL);
      turned = std::max(turned, gimbal.offset().norm());
    }
    EXPECT_GT(turned, 1.6);
    return std::abs(energy() - before);
  };
  const double coarse = gained(1e-3);
  const double fine = gained(1e-5);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.02 * coarse);
}

/// A wall of torque -K angle: its swing grows above the eigenvalue boundary and decays below.
TEST(SimulatedGimbal, RotationalWallTurnsUnstableAtTheExactBoundary) {
  struct Case {
    double inertia, damping, period;
    int delay;
  };
  for (const Case& c : {Case{1e-4, 2e-3, 1e-3, 0}, Case{3e-5, 5e-4, 2e-4, 0}, Case{1e-4, 2e-3, 1e-3, 3}}) {
    const double critical = critical_stiffness({turning(c.inertia, c.damping), c.period, c.delay});
    if (c.delay == 0) {
      EXPECT_NEAR(critical, critical_stiffness_without_delay(c.inertia, c.damping, c.period),
                  1e-7 * critical);
    }
    const auto growth = [&](double stiffness) {
      SimulatedGimbal gimbal(turning(c.inertia, c.damping), c.period, LEVEL, NOTHING, 0.0);
      gimbal.strike(Vec3(0.0, 0.01, 0.0));
      std::vector<Vec3> under_way(static_cast<std::size_t>(c.delay), NOTHING);
      const auto swing = [&] {
        double most = 0.0;
        for (int n = 0; n < 4000; ++n) {
          under_way.push_back(-stiffness * rotation_vector_of(gimbal.sensed_orientation()));
          gimbal.advance(under_way.front(), LEVEL);
          under_way.erase(under_way.begin());
          most = std::max(most, gimbal.offset().norm());
        }
        return most;
      };
      const double first = swing();
      for (int i = 0; i < 4; ++i) swing();
      return swing() / first;
    };
    EXPECT_LT(growth(0.999 * critical), 1.0);
    EXPECT_GT(growth(1.001 * critical), 1.0);
  }
}

TEST(SimulatedGimbal, SensesWholeCountsFromItsStart) {
  const Quaterniond start = rotation_of(Vec3(0.3, -1.0, 2.0));
  SimulatedGimbal coarse(turning(1e-4, 2e-3), 1e-3, start, Vec3(0.0, 0.0, 1e-2), 1e-3);
  EXPECT_LT(coarse.sensed_orientation().angularDistance(start), 1e-15);
  for (int n = 0; n < 20; ++n) coarse.advance(NOTHING, start);
  const double turned = coarse.offset().z();
  ASSERT_GT(turned, 2e-3);
  const Vec3 sensed = rotation_vector_of(coarse.sensed_orientation() * start.conjugate());
  EXPECT_NEAR(sensed.z(), 1e-3 * std::round(turned / 1e-3), 1e-12);
  EXPECT_GT(std::abs(sensed.z() - turned), 1e-6);
}

RC_GTEST_PROP(SimulatedGimbal, EnergyBalanceCloses, ()) {
  const auto number = [](double least, double most) {
    return least + (most - least) * (*rc::gen::inRange(0, 1000001)) / 1e6;
  };
  DeviceDynamics dynamics = turning(number(1e-5, 1e-3), number(0.0, 1e-2));
  dynamics.friction_n = number(0.0, 2e-3);
  if (*rc::gen::arbitrary<bool>())
    dynamics.hand = Hand{"custom", number(1e-5, 1e-3), number(0.0, 0.05), number(0.0, 2.0), 0.0, 0.0};
  SimulatedGimbal gimbal(dynamics, 1e-3, rotation_of(Vec3(1.0, 2.0, -0.5)),
                         Vec3(number(-0.01, 0.01), 0.0, 0.0), 0.0);
  const Vec3 rate(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0));
  for (int n = 1; n <= 200; ++n) {
    const Vec3 torque = 0.02 * Vec3(std::sin(0.1 * n), std::cos(0.07 * n), std::sin(0.2 * n));
    gimbal.advance(torque, rotation_of(1e-3 * n * rate) * rotation_of(Vec3(1.0, 2.0, -0.5)));
    RC_ASSERT(gimbal.energy().balance_error() <= 1e-12);
  }
  RC_ASSERT(gimbal.energy().moved > 0.0);
}

}  // namespace
}  // namespace lmdbench
