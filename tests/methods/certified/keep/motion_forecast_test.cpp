// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/keep/certificate_queue.h>
#include <lmdbench/methods/certified/keep/motion_forecast.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::random_direction;
using testing::uniform;

/// A hand's motion: smooth, with a tremor.
RigidTransform frame_of_motion(int frame, double speed, double tremor, std::mt19937_64& random) {
  const double t = speed * frame;
  Pose pose;
  pose.translation =
      Vec3(0.3 * std::sin(t), 0.2 * std::sin(0.7 * t + 1.0), 0.1 * t) + tremor * random_direction(random);
  pose.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.4 * std::sin(0.9 * t), Vec3(1.0, 2.0, 0.5).normalized()) *
                         Eigen::AngleAxisd(tremor * uniform(random), Vec3::UnitY()));
  return RigidTransform(pose);
}

/// Mean drift of a random walk on top of a steady motion.
double mean_drift_of_walk(double steady, double tremor, bool& goes_on) {
  std::mt19937_64 random(5);
  MotionForecast forecast;
  RigidTransform X;
  forecast.reset(X, 0.5, 0.1);
  double drift = 0.0;
  constexpr int FRAMES = 400;
  for (int frame = 1; frame <= FRAMES; ++frame) {
    X.translation += steady * Vec3::UnitX() + tremor * random_direction(random);
    forecast.advance(X, 1e-12);
    drift += forecast.drift() / FRAMES;
  }
  goes_on = !forecast.origin_velocity().isZero(0.0);
  return drift;
}

TEST(MotionForecast, GoesOnWithAMotionAndStaysWhereOneTrembles) {
  bool goes_on = false;
  mean_drift_of_walk(1e-3, 0.0, goes_on);
  EXPECT_TRUE(goes_on);
  mean_drift_of_walk(1e-3, 1e-4, goes_on);
  EXPECT_TRUE(goes_on);
  // A walk of k random steps gets sqrt(k) steps far, and no step predicts the next.
  const double drift = mean_drift_of_walk(0.0, 1e-3, goes_on);
  EXPECT_FALSE(goes_on);
  EXPECT_LT(drift, 1e-3);
  EXPECT_GT(drift, 1e-4);
}

TEST(MotionForecast, NothingIsFartherFromItsForecastThanTheDeviation) {
  constexpr double RADIUS = 0.5, LEVER = 0.2, TINY = 1e-9;
  struct Plan {
    int frame;
    std::size_t epoch;
    RigidTransform X;
    Vec3 velocity;
    Mat3 turn;
    double creep, spin, longest, used_at_start;
  };
  std::mt19937_64 random(1);
  std::size_t tight = 0, judged = 0;
  for (const auto& [speed, tremor] : {std::pair{0.01, 0.0}, {0.01, 1e-4}, {0.0, 1e-3}}) {
    MotionForecast forecast;
    std::vector<Plan> plans;
    for (int frame = 0; frame < 600; ++frame) {
      const RigidTransform X = frame_of_motion(frame, speed, tremor, random);
      if (frame == 0) {
        forecast.reset(X, RADIUS, LEVER);
        continue;
      }
      forecast.advance(X, 1e-12);
      // An epoch of unknown deviation is forgotten; its plans end.
      std::erase_if(plans, [&](const Plan& plan) {
        return forecast.deviation(plan.epoch) == std::numeric_limits<double>::infinity();
      });
      for (const Plan& plan : plans) {
        const int tau = frame - plan.frame;
        if (tau > plan.longest) continue;
        const double deviation = forecast.deviation(plan.epoch) + plan.used_at_start;
        const double angle = Eigen::AngleAxisd(Mat3(X.rotation * plan.X.rotation.transpose())).angle();
        const double not_forecast = std::max(angle - tau * plan.spin, 0.0);
        for (int k = 0; k < 4; ++k) {
          const Vec3 c = RADIUS * uniform(random) * random_direction(random);
          const Vec3 rest = X.point(c) - plan.X.point(c) - tau * (plan.turn * c + plan.velocity);
          const double lever_arm = forecast.extent() - c.norm();
          EXPECT_LE(rest.norm() + lever_arm * not_forecast, tau * plan.creep + deviation + TINY)
              << frame << " from " << plan.frame;
          ++judged;
          if (deviation < 1e-3) ++tight;
        }
      }
      if (forecast.longest_plan() >= 1.0)
        plans.push_back({frame, forecast.epoch(), X, forecast.origin_velocity(), forecast.turn(),
                         forecast.creep(), forecast.spin(), forecast.longest_plan(),
                         forecast.used_at_start()});
      if (plans.size() > MotionForecast::LONGEST_PLAN) plans.erase(plans.begin());
    }
  }
  EXPECT_GT(judged, 100000u);
  EXPECT_GT(tight, 10000u);
}

TEST(MotionForecast, SeesASteadyMotionComing) {
  MotionForecast forecast;
  const auto pose = [](int frame) {
    return RigidTransform(Pose{Vec3(1e-4 * frame, 0.0, 0.0),
                               Eigen::Quaterniond(Eigen::AngleAxisd(1e-3 * frame, Vec3::UnitZ()))});
  };
  forecast.reset(pose(0), 0.1, 0.01);
  for (int frame = 1; frame <= 61; ++frame) forecast.advance(pose(frame), 0.0);
  // A turn of 0.06 in sixty frames leaves an error of third order.
  std::size_t remembered = 0;
  for (std::size_t epoch = 0; epoch < MotionForecast::EPOCHS; ++epoch) {
    if (forecast.deviation(epoch) == std::numeric_limits<double>::infinity()) continue;
    EXPECT_LT(forecast.deviation(epoch), 0.21 * 0.06 * 0.06 * 0.06);
    ++remembered;
  }
  EXPECT_GT(remembered, 10u);
}

class CertificateQueueTest : public ::testing::Test {
 protected:
  CertificateQueueTest() { forecast.reset(RigidTransform(), 0.1, 0.01); }
  std::vector<std::uint32_t> next(double x) {
    RigidTransform X;
    X.translation.x() = x;
    forecast.advance(X, 0.0);
    std::vector<std::uint32_t> due;
    queue.collect(forecast, due, scratch);
    return due;
  }
  MotionForecast forecast;
  CertificateQueue queue;
  CertificateQueue::Scratch scratch;
};

TEST_F(CertificateQueueTest, GoOffWhenTheirFramesAreOver) {
  double x = 0.0;
  EXPECT_TRUE(next(x += 0.001).empty());
  const std::uint32_t first = queue.add(), second = queue.add(), third = queue.add();
  queue.plan(first, 3.5, 1.0, forecast);
  queue.plan(second, 1e9, 1.0, forecast);
  queue.plan(third, 2.0, 1.0, forecast);
  queue.drop(third);
  for (int frame = 1; frame <= 70; ++frame) {
    const auto due = next(x += 0.001);
    // The plan is for 3.5 frames: valid after 3 frames, due after 4.
    if (frame == 4) {
      EXPECT_EQ(due, std::vector<std::uint32_t>{first});
    } else if (frame == static_cast<int>(MotionForecast::LONGEST_PLAN) + 1) {
      EXPECT_EQ(due, std::vector<std::uint32_t>{second});
    } else {
      EXPECT_TRUE(due.empty()) << frame;
    }
  }
  EXPECT_EQ(queue.count(), 2u);
  EXPECT_EQ(queue.add(), third);
}

TEST_F(CertificateQueueTest, GoOffWhenTheMotionDeviates) {
  next(0.001);
  const std::uint32_t narrow = queue.add(), wide = queue.add();
  queue.plan(narrow, 50.0, 0.01, forecast);
  queue.plan(wide, 50.0, 0.1, forecast);
  EXPECT_TRUE(next(0.002).empty());
  EXPECT_TRUE(next(0.0092).empty());  // 0.0062 from 0.003, the forecast
  EXPECT_EQ(next(0.004 + 0.011), std::vector<std::uint32_t>{narrow});
  EXPECT_TRUE(next(0.005).empty());
  EXPECT_EQ(next(0.2), std::vector<std::uint32_t>{wide});
}

TEST_F(CertificateQueueTest, WhatAnEpochDeviatedByBeforeAPlanIsTakenFromItsBudget) {
  for (int frame = 0; frame < 9; ++frame) next(0.0);
  // Planned ahead of the forecast, then behind it: together further than the budget.
  const std::size_t epoch = forecast.epoch();
  next(0.010);
  ASSERT_EQ(forecast.epoch(), epoch) << "in the middle of an epoch";
  const std::uint32_t only = queue.add();
  queue.plan(only, 50.0, 0.015, forecast);
  EXPECT_EQ(next(-0.0075), std::vector<std::uint32_t>{only}) << "0.0175 from where it was planned";
}

TEST_F(CertificateQueueTest, NoPlanStandsMoreThanItsBudgetNorMuchLess) {
  next(0.0);
  std::mt19937_64 random(3);
  std::vector<double> budgets;
  for (int i = 0; i < 1000; ++i) {
    budgets.push_back(forecast.extent() * std::exp2(-14.0 * uniform(random)));
    queue.plan(queue.add(), 50.0, budgets.back(), forecast);
  }
  // The motion was at rest when they were planned.
  std::size_t ended = 0;
  double x = 0.0, before = 0.0;
  for (int frame = 0; frame < 28; ++frame) {
    x = forecast.extent() * std::exp2(0.5 * frame - 13.75);
    for (const std::uint32_t index : next(x)) {
      EXPECT_LT(budgets[index], 1.51 * x);
      EXPECT_GT(budgets[index], before);
      budgets[index] = std::numeric_limits<double>::infinity();
      ++ended;
    }
    before = x;
    for (const double budget : budgets) EXPECT_GT(budget, x);
  }
  EXPECT_EQ(ended, budgets.size());
}

TEST_F(CertificateQueueTest, WhatStandsLongestDoesNotEndInOneFrame) {
  next(0.0);
  constexpr std::size_t THINGS = 4096;
  for (std::size_t i = 0; i < THINGS; ++i) queue.plan(queue.add(), 1e9, 1.0, forecast);
  std::size_t most = 0, ended = 0;
  for (std::uint32_t frame = 1; frame <= MotionForecast::LONGEST_PLAN + 1; ++frame) {
    const std::vector<std::uint32_t> due = next(0.0);
    if (frame <= MotionForecast::LONGEST_PLAN / 2) {
      EXPECT_TRUE(due.empty()) << "no plan is shorter than half";
    }
    EXPECT_TRUE(std::is_sorted(due.begin(), due.end()));
    most = std::max(most, due.size());
    ended += due.size();
  }
  EXPECT_EQ(ended, THINGS);
  EXPECT_LE(most, THINGS / 8);
}

TEST_F(CertificateQueueTest, WhatIsDueWhateverTheMotionComesFirst) {
  next(0.0);
  const std::uint32_t planned = queue.add(), first = queue.add(), second = queue.add();
  queue.plan(planned, 0.5, 1.0, forecast);
  queue.plan_next(second, forecast);
  queue.plan_next(first, forecast);
  EXPECT_EQ(next(0.0), (std::vector<std::uint32_t>{first, second, planned}));
}

TEST_F(CertificateQueueTest, PlansEndBeforeTheirEpochIsForgotten) {
  // As a motion begins to tremble, epochs get shorter: older ones are forgotten before plans end.
  double x = 0.0;
  for (int frame = 0; frame < 8; ++frame) next(x += 1e-3);
  const std::uint32_t only = queue.add();
  queue.plan(only, 60.0, 1.0, forecast);
  const std::size_t epoch = forecast.epoch();
  std::mt19937_64 random(4);
  bool forgotten = false, ended = false;
  for (int frame = 0; frame < 59 && !ended; ++frame) {
    const std::vector<std::uint32_t> due = next(x + 1e-4 * uniform(random));
    ended = !due.empty();
    forgotten = frame > 3 && forecast.epoch() == epoch;
    EXPECT_TRUE(ended || !forgotten);
  }
  EXPECT_TRUE(forgotten && ended);
}

}  // namespace
}  // namespace lmdbench
