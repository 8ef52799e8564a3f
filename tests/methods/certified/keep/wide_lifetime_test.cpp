// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/keep/wide_lifetime.h>

#include "methods/certified/traverse/wide_samples.h"
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lmdbench {
namespace {

using testing::expect_same_lifetimes;
using testing::for_each_random_node_test;
using testing::LaneSample;
using testing::random_direction;
using testing::uniform;

float random_float(double largest, std::mt19937_64& random) {
  return static_cast<float>(largest * uniform(random));
}

TEST(WideLifetime, VectorAndScalarAgreeBitForBit) {
  std::mt19937_64 random(4);
  std::size_t alive = 0, dead = 0;
  bool moving_lanes = false;
  for_each_random_node_test(random, [&](const WideQuery& query, const WideNode& node, const WideProbe& probe,
                                        const WideWidthTest* widths) {
    moving_lanes = !moving_lanes;
    WideForecast forecast;
    forecast.in_moving = WideTransform(0.01 * testing::random_rotation(random).toRotationMatrix(),
                                       0.01 * random_direction(random));
    forecast.creep = random_float(1e-3, random);
    forecast.spin = random_float(1e-2, random);
    forecast.search_distance = query.limits.reach;
    forecast.base = random_float(1e-3, random);
    forecast.drift = random_float(1e-3, random);
    forecast.extent = 3.0F;
    const WideLifetimeTest test{
        moving_lanes,
        {random_float(0.01, random), random_float(0.01, random), -random_float(0.01, random)},
        static_cast<std::uint32_t>(random() & 0xFFu),
        random_float(3.0, random)};
    forecast.horizon = random_float(4.0, random);
    const WideLifetimes scalar =
        test_lanes_lifetime_scalar(node, probe, query.limits, forecast, test, widths);
    const WideLifetimes vector = test_lanes_lifetime(node, probe, query.limits, forecast, test, widths);
    ASSERT_NO_FATAL_FAILURE(expect_same_lifetimes(vector, scalar));
    ++(scalar.lmd != 0 ? alive : dead);
  });
  EXPECT_GT(alive, 100u);
  EXPECT_GT(dead, 100u);
}

/// Two children that hold an LMD at the end of a motion of the first one's mesh.
struct EndsAsLmd {
  LaneSample a, b;  ///< As they are at the end, in one frame.
  double cutoff, frames, angle;
  double turn_deviation;  ///< Angle that was not forecast.
  double deviation;       ///< How far the centre is from its forecast.
  Mat3 turn;              ///< From the start to the end.
  Vec3 displacement;      ///< Of a's centre.
  Vec3 velocity;          ///< That was forecast for it; the rest has deviated.

  explicit EndsAsLmd(std::mt19937_64& random) : a(random), b(random) {
    cutoff = 0.2 * uniform(random);
    const double distance = cutoff * uniform(random);
    const Mat3 opposite = Eigen::Quaterniond::FromTwoVectors(b.direction, -a.direction).toRotationMatrix();
    b.turn(opposite, a.point + distance * a.direction - opposite * b.point);
    frames = 20.0 * uniform(random);
    angle = 0.3 * uniform(random) * uniform(random) * uniform(random);
    turn = Eigen::AngleAxisd(angle, random_direction(random)).toRotationMatrix();
    displacement = 0.5 * uniform(random) * random_direction(random);
    deviation = 0.1 * uniform(random) * uniform(random) * uniform(random);
    turn_deviation = std::min(angle, deviation / a.centre.norm()) * uniform(random);
    velocity = (displacement + deviation * random_direction(random)) / frames;
  }
};

TEST(WideLifetime, NothingIsAnLmdBeforeItsFramesAreOver) {
  std::mt19937_64 random(5);
  std::size_t rejected = 0, beyond = 0, held = 0, by_width = 0;
  for (int i = 0; i < 400000; ++i) {
    const EndsAsLmd pair(random);
    // The moving mesh's frame is the world at the end of the motion. At its start, points were at
    // start_centre + turn^-1 (x - centre).
    const Vec3 start_centre = pair.a.centre - pair.displacement;
    const Mat3 back = pair.turn.transpose();
    const RigidTransform X_start = [&] {
      RigidTransform X;
      X.rotation = back;
      X.translation = start_centre - back * pair.a.centre;
      return X;
    }();
    const bool moving_lanes = i % 2 == 1;
    WideNode home{}, node{};
    (moving_lanes ? pair.b : pair.a).store(home, 0);
    (moving_lanes ? pair.a : pair.b).store(node, 3);
    const Mat3 to_moving = X_start.rotation.transpose();
    const WideTransform place = moving_lanes ? WideTransform(to_moving, -(to_moving * X_start.translation))
                                             : WideTransform(X_start.rotation, X_start.translation);
    const WideProbe probe = make_probe(WideChild(home, 0), place);
    WideWidths of_home{}, of_node{};
    (moving_lanes ? pair.b : pair.a).store(of_home, 0);
    (moving_lanes ? pair.a : pair.b).store(of_node, 3);
    const WideWidthTest widths = make_width_test(of_node, of_home, 0, place);
    const double size = 3.0 + pair.b.centre.norm();
    const WideLimits limits{static_cast<float>(pair.cutoff * (1.0 + 1e-7)), 0.0F,
                            static_cast<float>(POSITION_ROUNDING * size)};
    WideForecast forecast;
    const Vec3 velocity_M = to_moving * pair.velocity;
    forecast.in_moving = WideTransform(Mat3::Zero(), velocity_M);
    forecast.spin = static_cast<float>((pair.angle - pair.turn_deviation) / pair.frames * 1.0001);
    forecast.creep = static_cast<float>(1e-5 * pair.velocity.norm());
    forecast.search_distance = static_cast<float>(pair.cutoff * 1.0001);
    forecast.base = random_float(0.01, random);
    forecast.drift = random_float(0.01, random);
    forecast.extent = i / 4 % 2 == 0 ? 4.0F : 0.4F;
    WideLifetimeTest test{moving_lanes, {}, 0u, static_cast<float>(pair.a.centre.norm())};
    for (int k = 0; k < 3; ++k) test.probe_velocity[k] = static_cast<float>(pair.velocity[k]);
    const bool with_widths = i / 2 % 2 == 1;
    const WideLifetimes result =
        test_lanes_lifetime(node, probe, limits, forecast, test, with_widths ? &widths : nullptr);
    if (result.lmd != 0) continue;
    ++rejected;
    if (with_widths && test_lanes_lifetime(node, probe, limits, forecast, test).lmd != 0) ++by_width;
    // The turn moves the centre; the remaining deviation is the origin's.
    const double deviation = pair.deviation - pair.turn_deviation * pair.a.centre.norm() +
                             pair.turn_deviation * static_cast<double>(forecast.extent);
    if (deviation > static_cast<double>(result.deviation_budget)) {
      ++beyond;
      continue;
    }
    ASSERT_LE(static_cast<double>(result.frames), pair.frames * (1.0 + 1e-5)) << i;
    ++held;
  }
  EXPECT_GT(rejected, 20000u);
  EXPECT_GT(beyond, 1000u);
  EXPECT_GT(held, 5000u);
  EXPECT_GT(by_width, 1000u);
}

/// The turn changes only how far a direction is outside a cone, by all that lemma 15 of PROOF.md
/// allows: a disc with a wide cone round its axis turns a point of its rim up to a point beside it.
TEST(WideLifetime, ATurnLeavesAConeNoEarlierThanItsFramesAreOver) {
  constexpr double CONE = 80.0 * std::numbers::pi / 180.0, BESIDE = 1e-3;
  std::mt19937_64 random(1);
  LaneSample disc(random), point(random);
  disc.centre = Vec3::Zero();
  disc.axis = Vec3::UnitZ();
  disc.radius = 1.0;
  disc.thickness = 0.0;
  disc.cosine = std::cos(CONE);
  point.centre = {1.0 + BESIDE, 0.0, 0.0};
  point.axis = -Vec3::UnitX();
  point.radius = point.thickness = point.cosine = 0.0;
  // The disc turns until the point is that far above the rim; from then on it is inside the cone.
  const double turn = std::atan(BESIDE / std::tan(CONE));
  WideForecast forecast;
  forecast.spin = 1e-5F;  // The turn takes fewer frames than the longest plan.
  forecast.search_distance = 0.01F;
  forecast.extent = 4.0F;
  for (const bool moving_lanes : {false, true}) {
    WideNode home{}, node{};
    (moving_lanes ? point : disc).store(home, 0);
    (moving_lanes ? disc : point).store(node, 3);
    const WideProbe probe = make_probe(WideChild(home, 0), WideTransform(Mat3::Identity(), Vec3::Zero()));
    const WideLimits limits{0.01F, 0.0F, static_cast<float>(2.0 * POSITION_ROUNDING)};
    const WideLifetimes result = test_lanes_lifetime(node, probe, limits, forecast, {moving_lanes, {}, 0u});
    EXPECT_EQ(result.lmd, 0u);
    const double forecast_turn = static_cast<double>(forecast.spin) * static_cast<double>(result.frames);
    // What is left for deviations may be a turn as well.
    const double any_turn =
        static_cast<double>(result.deviation_budget) / static_cast<double>(forecast.extent);
    EXPECT_LE(forecast_turn + any_turn, turn);
    EXPECT_GT(forecast_turn, 0.3 * turn);
  }
}

/// Lifetimes of the test of two children in one frame, of which one moves without a turn.
/// @param velocity  a frame
WideLifetimes lifetimes_along(const LaneSample& moving, const LaneSample& fixed, const Vec3& velocity,
                              bool moving_lanes, const WideLimits& limits) {
  WideNode home{}, node{};
  (moving_lanes ? fixed : moving).store(home, 0);
  (moving_lanes ? moving : fixed).store(node, 3);
  WideForecast forecast;
  forecast.in_moving = WideTransform(Mat3::Zero(), velocity);
  forecast.creep = static_cast<float>(1e-5 * velocity.norm());
  forecast.search_distance = limits.reach;
  forecast.extent = 8.0F;
  WideLifetimeTest test{moving_lanes, {}, 0u};
  for (int k = 0; k < 3; ++k) test.probe_velocity[k] = static_cast<float>(velocity[k]);
  const WideProbe probe = make_probe(WideChild(home, 0), WideTransform(Mat3::Identity(), Vec3::Zero()));
  return test_lanes_lifetime(node, probe, limits, forecast, test);
}

/// A body straight behind a cone passes it on the side and comes into it in front. Next to the
/// axis squares cancel: how far it is from the axis, and how fast it gets away, are not known.
TEST(WideLifetime, WhatComesRoundFromBehindAConeIsNotForgotten) {
  constexpr double BEHIND = 2.2, RADIUS = 0.1;
  const Vec3 velocity(0.015, 0.0, 0.06);  // Of the body, a frame.
  std::mt19937_64 random(1);
  LaneSample cone(random), body(random);
  cone.centre = Vec3::Zero();
  cone.axis = Vec3::UnitZ();
  cone.cosine = 0.5;
  body.axis = Vec3::Zero();
  body.cosine = 0.0;
  cone.radius = cone.thickness = body.radius = RADIUS;
  body.thickness = 1e18;
  for (const double beside : {1e-2, 1e-3, 1e-4, 0.0}) {
    body.centre = {beside, 0.0, -BEHIND};
    double frames = 0.0;
    for (Vec3 d = body.centre; d.norm() > 1.0 || d.z() < cone.cosine * d.norm(); ++frames) d += velocity;
    for (const bool moving_lanes : {false, true}) {
      const WideLifetimes result = lifetimes_along(body, cone, velocity, moving_lanes, {1.0F, 0.0F, 1e-5F});
      EXPECT_EQ(result.lmd, 0u);
      EXPECT_LT(static_cast<double>(result.frames), frames) << beside << " beside the axis";
    }
  }
}

/// A point beside a narrow cone gets away along it and drifts to its axis, from so near that what
/// is left of the growth of |D across u|^2 is rounding.
TEST(WideLifetime, NothingDriftsIntoANarrowConeBeforeItsFramesAreOver) {
  std::mt19937_64 random(9);
  int rejected = 0;
  for (int i = 0; i < 200000; ++i) {
    LaneSample cone(random), point(random);
    const double away = 0.01 + uniform(random), beside = away * 1.5e-3 * std::pow(10.0, uniform(random)),
                 frames = 2.0 + 30.0 * uniform(random);
    const Vec3 sideways = cone.axis.unitOrthogonal();
    cone.centre = 0.1 * uniform(random) * random_direction(random);
    cone.radius = cone.thickness = 0.0;
    cone.cosine = 1.0;
    point.centre = cone.centre + away * cone.axis + beside * sideways;
    point.axis = -cone.axis;
    point.radius = point.thickness = 0.0;
    const Vec3 velocity = uniform(random) * away / frames * cone.axis - beside / frames * sideways;
    const WideLimits limits{3.0F, 0.0F, static_cast<float>(POSITION_ROUNDING * 2.0 * away)};
    const WideLifetimes result = lifetimes_along(point, cone, velocity, i % 2 == 1, limits);
    if (result.lmd != 0) continue;
    ++rejected;
    ASSERT_LE(static_cast<double>(result.frames), frames) << i << ", " << beside / away;
  }
  EXPECT_GT(rejected, 50000);
}

/// Two children, a point of each of which touches the other at the end of a motion.
TEST(WideLifetime, NothingTouchesBeforeItsFramesAreOver) {
  std::mt19937_64 random(6);
  std::size_t apart = 0, held = 0, by_width = 0;
  for (int i = 0; i < 200000; ++i) {
    LaneSample a(random), b(random);
    const Vec3 together = a.point - b.point;  // at the end, in the frame of both
    b.centre += together;
    const double frames = 1.0 + 20.0 * uniform(random);
    const Vec3 velocity = 0.05 * uniform(random) * random_direction(random);
    // A motion without a turn: at the start a is behind by the displacement.
    const bool moving_lanes = i % 2 == 1;
    const Vec3 displacement = frames * velocity;
    LaneSample start = a;
    start.centre -= displacement;
    WideNode home{}, node{};
    (moving_lanes ? b : start).store(home, 0);
    (moving_lanes ? start : b).store(node, 3);
    const WideTransform same_frame(Mat3::Identity(), Vec3::Zero());
    const WideProbe probe = make_probe(WideChild(home, 0), same_frame);
    WideWidths of_home{}, of_node{};
    (moving_lanes ? b : start).store(of_home, 0);
    (moving_lanes ? start : b).store(of_node, 3);
    const WideWidthTest widths = make_width_test(of_node, of_home, 0, same_frame);
    const double size = 3.0 + b.centre.norm() + displacement.norm();
    const WideLimits limits{0.2F, 1e-9F, static_cast<float>(POSITION_ROUNDING * size)};
    WideForecast forecast;
    forecast.in_moving = WideTransform(Mat3::Zero(), velocity);
    forecast.creep = static_cast<float>(1e-5 * velocity.norm());
    forecast.search_distance = 0.2F;
    forecast.extent = 4.0F;
    WideLifetimeTest test{moving_lanes, {}, 1u << 3};
    for (int k = 0; k < 3; ++k) test.probe_velocity[k] = static_cast<float>(velocity[k]);
    const bool with_widths = i / 2 % 2 == 1;
    const WideLifetimes result =
        test_lanes_lifetime(node, probe, limits, forecast, test, with_widths ? &widths : nullptr);
    if (result.touch != 0) continue;
    ++apart;
    if (with_widths && test_lanes_lifetime(node, probe, limits, forecast, test).touch != 0) ++by_width;
    ASSERT_LE(static_cast<double>(result.frames), frames * (1.0 + 1e-5)) << i;
    // The bound is useful: it covers a good part of the motion.
    if (static_cast<double>(result.frames) > 0.3 * frames) ++held;
  }
  EXPECT_GT(apart, 20000u);
  EXPECT_GT(held, 2000u);
  EXPECT_GT(by_width, 1000u);
}

TEST(WideLifetime, TouchingIsAskedForLanesOfFacesAlone) {
  std::mt19937_64 random(7);
  LaneSample a(random), b(random);
  a.centre = b.centre = Vec3::Zero();
  a.radius = b.radius = a.thickness = b.thickness = 0.1;
  WideNode home{}, node{};
  a.store(home, 0);
  b.store(node, 2);
  const WideProbe probe = make_probe(WideChild(home, 0), WideTransform(Mat3::Identity(), Vec3::Zero()));
  WideForecast forecast;
  forecast.search_distance = 0.2F;
  forecast.extent = 4.0F;
  const auto touch = [&](std::uint32_t lanes) {
    return test_lanes_lifetime(node, probe, {0.2F, 1e-9F, 1e-6F}, forecast, {false, {}, lanes}).touch;
  };
  EXPECT_EQ(touch(1u << 2), 1u << 2) << "bodies that overlap may touch, whatever their cones";
  EXPECT_EQ(touch(1u << 1), 0u);
}

/// Two spheres of radius 0.1 whose cones face each other, 0.6 beyond the cutoff.
struct BeyondCutoff {
  WideNode home{}, node{};
  WideForecast forecast;

  BeyondCutoff() {
    std::mt19937_64 random(1);
    LaneSample a(random), b(random);
    a.centre = Vec3::Zero();
    b.centre = {1.0, 0.0, 0.0};
    a.axis = Vec3::UnitX();
    b.axis = -Vec3::UnitX();
    a.radius = b.radius = a.thickness = b.thickness = 0.1;
    a.store(home, 0);
    b.store(node, 0);
    forecast.search_distance = 0.2F;
    forecast.extent = 4.0F;
  }
  /// Of a motion of the first one at `speed` towards the second.
  WideLifetimes plan(float speed) const {
    const WideProbe probe = make_probe(WideChild(home, 0), WideTransform(Mat3::Identity(), Vec3::Zero()));
    return test_lanes_lifetime(node, probe, {0.2F, 0.0F, 1e-6F}, forecast, {false, {speed, 0.0F, 0.0F}, 0u});
  }
};

TEST(WideLifetime, DirectionOfTheMotionCounts) {
  // Its rejection is valid for few frames of approach, else for ever.
  const BeyondCutoff pair;
  const auto frames = [&](float speed) { return pair.plan(speed).frames; };
  EXPECT_GE(frames(0.02F), 0.99F * 0.6F * (1.0F - DEVIATION_SHARE) / 0.02F);
  EXPECT_LE(frames(0.02F), 0.6F / 0.02F);
  EXPECT_EQ(frames(-0.02F), static_cast<float>(MotionForecast::LONGEST_PLAN));
}

TEST(WideLifetime, ATurnCountsByHowFarItMovesTheChild) {
  // The child is farther than `reach` from its origin: a turn moves it by more than it counts.
  constexpr double FROM_ORIGIN = 1.0, REACH = 0.4, GAP = 0.7, CUTOFF = 0.1, RADIUS = 0.1;
  std::mt19937_64 random(1);
  LaneSample moving(random), fixed(random);
  moving.centre = {FROM_ORIGIN, 0.0, 0.0};
  fixed.centre = {FROM_ORIGIN + GAP + 2.0 * RADIUS, 0.0, 0.0};
  moving.axis = Vec3::UnitX();
  fixed.axis = -Vec3::UnitX();
  moving.radius = fixed.radius = moving.thickness = fixed.thickness = RADIUS;
  WideForecast forecast;
  forecast.search_distance = static_cast<float>(CUTOFF);
  forecast.extent = static_cast<float>(REACH);
  for (const bool moving_lanes : {false, true}) {
    WideNode home{}, node{};
    (moving_lanes ? fixed : moving).store(home, 0);
    (moving_lanes ? moving : fixed).store(node, 3);
    const WideProbe probe = make_probe(WideChild(home, 0), WideTransform(Mat3::Identity(), Vec3::Zero()));
    const WideLimits limits{static_cast<float>(CUTOFF), 0.0F, 1e-6F};
    const WideLifetimes result = test_lanes_lifetime(node, probe, limits, forecast,
                                                     {moving_lanes, {}, 0u, static_cast<float>(FROM_ORIGIN)});
    // A turn by a moves the centre by a FROM_ORIGIN, and counts as a REACH.
    const double angle = (GAP - CUTOFF) / (FROM_ORIGIN + RADIUS + 2.0 * CUTOFF);
    EXPECT_NEAR(static_cast<double>(result.deviation_budget), angle * REACH, 1e-4);
  }
}

TEST(WideLifetime, WhatTremblesIsPlannedByDeviationsAlone) {
  // Recent deviations exceed the slack; a plan without a forecast motion still gets all of it.
  BeyondCutoff pair;
  pair.forecast.base = pair.forecast.drift = 1.0F;
  const WideLifetimes still = pair.plan(0.0F), moved = pair.plan(0.02F);
  EXPECT_EQ(still.frames, static_cast<float>(MotionForecast::LONGEST_PLAN));
  EXPECT_NEAR(still.deviation_budget, 0.6F, 1e-4F);
  // With one, motion and deviations share the slack.
  EXPECT_NEAR(moved.frames, LEAST_SHARE * 0.6F / 0.02F, 0.01F);
  EXPECT_NEAR(moved.deviation_budget, (1.0F - LEAST_SHARE) * 0.6F, 1e-4F);
}

}  // namespace
}  // namespace lmdbench
