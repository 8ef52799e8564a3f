// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/rotation_vector.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace lmdbench {
namespace {

TimedPose at_position(double time, const Vec3& translation) {
  return {time, {translation, Eigen::Quaterniond::Identity()}};
}

Path wandering_path(std::size_t count, double step) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  Path path;
  Pose pose;
  for (std::size_t i = 0; i < count; ++i) {
    path.push_back({2.0 + step * static_cast<double>(i), pose});
    pose.translation += 0.01 * Vec3(normal(generator), normal(generator), normal(generator));
    pose.rotation =
        (pose.rotation * rotation_of(0.2 * Vec3(normal(generator), normal(generator), normal(generator))))
            .normalized();
  }
  return path;
}

Vec3 velocity(const PathInterpolator& interpolator, double time, double h) {
  return (interpolator.at(time + h).translation - interpolator.at(time).translation) / h;
}

Vec3 angular_velocity(const PathInterpolator& interpolator, double time, double h) {
  return rotation_vector_of(interpolator.at(time).rotation.conjugate() * interpolator.at(time + h).rotation) /
         h;
}

/// Frames of a second at 100 Hz: 101.
TEST(Interpolate, ALimitIsOfTheFramesThatARunHas) {
  const PathInterpolator second({at_position(0.0, Vec3::Zero()), at_position(1.0, Vec3::UnitX())},
                                Interpolation::LINEAR);
  set_limit("frames=100");
  EXPECT_NO_THROW(refuse_too_many_frames(second, 100.0, 100, "a.tum"));
  EXPECT_NO_THROW(refuse_too_many_frames(second, 99.0, {}, "a.tum"));
  EXPECT_THAT(testing::message_of<InputError>([&] { refuse_too_many_frames(second, 100.0, {}, "a.tum"); }),
              ::testing::HasSubstr("101 frames at 100 Hz, above the limit of 100"));
  set_limit("frames=10000000");
}

TEST(Interpolate, GoesThroughEveryPoseBitForBit) {
  const Path path = wandering_path(40, 0.02);
  for (const Interpolation interpolation : {Interpolation::LINEAR, Interpolation::CUBIC}) {
    const PathInterpolator interpolator(path, interpolation);
    for (const TimedPose& timed : path) {
      const Pose pose = interpolator.at(timed.time);
      EXPECT_EQ(pose.translation, timed.pose.translation);
      EXPECT_EQ(pose.rotation.coeffs(), timed.pose.rotation.coeffs());
    }
  }
}

TEST(Interpolate, OutsideThePathTheEndsStay) {
  const Path path = wandering_path(5, 0.02);
  const PathInterpolator interpolator(path);
  EXPECT_EQ(interpolator.at(-1.0).translation, path.front().pose.translation);
  EXPECT_EQ(interpolator.at(99.0).translation, path.back().pose.translation);
}

TEST(Interpolate, CubicApproachesEveryPoseFromBothSides) {
  const Path path = wandering_path(40, 0.02);
  const PathInterpolator interpolator(path);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose before = interpolator.at(path[i].time - 1e-9);
    EXPECT_LT((before.translation - path[i].pose.translation).norm(), 1e-8);
    EXPECT_LT(rotation_vector_of(before.rotation.conjugate() * path[i].pose.rotation).norm(), 1e-7);
  }
}

TEST(Interpolate, CubicVelocitiesAreContinuousAndLinearOnesJump) {
  const Path path = wandering_path(40, 0.02);
  const PathInterpolator cubic(path, Interpolation::CUBIC);
  const PathInterpolator linear(path, Interpolation::LINEAR);
  const double h = 1e-7;
  double largest_jump_of_linear = 0.0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const double t = path[i].time;
    EXPECT_LT((velocity(cubic, t - h, h) - velocity(cubic, t, h)).norm(), 1e-3)
        << i;  // speeds are about 1 m/s
    EXPECT_LT((angular_velocity(cubic, t - h, h) - angular_velocity(cubic, t, h)).norm(), 2e-2)
        << i;  // 15 rad/s
    largest_jump_of_linear =
        std::max(largest_jump_of_linear, (velocity(linear, t - h, h) - velocity(linear, t, h)).norm());
  }
  EXPECT_GT(largest_jump_of_linear, 0.5);
}

TEST(Interpolate, CubicReproducesAcceleratedMotionOnUnevenTimes) {
  const auto position = [](double t) { return Vec3(1.0 + 2.0 * t - 3.0 * t * t, -t, 0.5 * t * t); };
  Path path;
  for (const double t : {0.0, 0.1, 0.15, 0.4, 0.5, 0.9}) path.push_back(at_position(t, position(t)));
  const PathInterpolator interpolator(path);
  for (double t = 0.0; t <= 0.9; t += 0.013)
    EXPECT_LT((interpolator.at(t).translation - position(t)).norm(), 1e-14) << t;
}

TEST(Interpolate, BothReproduceASteadyScrewMotion) {
  const Vec3 turn(0.3, -0.5, 0.7);  // rad/s
  const Vec3 speed(0.02, 0.1, -0.05);
  Path path;
  for (const double t : {0.0, 0.2, 0.5, 1.1, 2.0}) path.push_back({t, {t * speed, rotation_of(t * turn)}});
  for (const Interpolation interpolation : {Interpolation::LINEAR, Interpolation::CUBIC}) {
    const PathInterpolator interpolator(path, interpolation);
    for (double t = 0.0; t <= 2.0; t += 0.07) {
      EXPECT_LT((interpolator.at(t).translation - t * speed).norm(), 1e-15) << t;
      const Eigen::Quaterniond expected = rotation_of(t * turn);
      EXPECT_LT(rotation_vector_of(interpolator.at(t).rotation.conjugate() * expected).norm(), 1e-14) << t;
    }
  }
}

TEST(Interpolate, QuaternionSignsDoNotMatter) {
  const Path path = wandering_path(20, 0.02);
  Path flipped = path;
  for (std::size_t i = 0; i < flipped.size(); i += 3) flipped[i].pose.rotation.coeffs() *= -1.0;
  for (const Interpolation interpolation : {Interpolation::LINEAR, Interpolation::CUBIC}) {
    const PathInterpolator a(path, interpolation);
    const PathInterpolator b(flipped, interpolation);
    for (double t = a.start_time(); t < a.end_time(); t += 0.0013)
      EXPECT_LT(rotation_vector_of(a.at(t).rotation.conjugate() * b.at(t).rotation).norm(), 1e-13) << t;
  }
}

TEST(Interpolate, QuaternionsStayUnit) {
  const PathInterpolator interpolator(wandering_path(20, 0.02));
  for (double t = interpolator.start_time(); t < interpolator.end_time(); t += 0.0007)
    EXPECT_NEAR(interpolator.at(t).rotation.squaredNorm(), 1.0, 1e-15);
}

TEST(Interpolate, KeepsMillimetresFarFromTheOrigin) {
  const double far = 1e6;
  const PathInterpolator interpolator(Path{at_position(0.0, Vec3(far, 0, 0)),
                                           at_position(1.0, Vec3(far + 1e-3, 0, 0)),
                                           at_position(2.0, Vec3(far + 2e-3, 0, 0))});
  EXPECT_NEAR(interpolator.at(0.5).translation.x() - far, 5e-4, 2e-10);
}

TEST(Resample, FramesAreExactInTime) {
  Path path = wandering_path(11, 0.1);
  for (std::size_t i = 0; i < path.size(); ++i) path[i].time = static_cast<double>(i) / 250.0;
  const PathInterpolator interpolator(path);
  const Path frames = resample(interpolator, 1000.0);
  ASSERT_EQ(frames.size(), 41u);
  for (std::size_t k = 0; k < frames.size(); ++k) EXPECT_EQ(frames[k].time, static_cast<double>(k) / 1000.0);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_EQ(frames[4 * i].pose.translation, path[i].pose.translation)
        << "the 250 Hz poses are frames themselves";
}

TEST(Resample, KeepsTheLastFrameInSpiteOfRounding) {
  // Steps of 0.1 s add up to an ulp or so less than 0.3 s + start.
  Path path(2);
  path[0].time = 0.1;
  path[1].time = std::nextafter(0.4, 0.0);
  EXPECT_EQ(frame_count(PathInterpolator(path), 1000.0), 301u);
  path[1].time = 0.3995;
  EXPECT_EQ(frame_count(PathInterpolator(path), 1000.0), 300u);
  // Seconds since 1970, whose doubles are 2.4e-7 apart.
  path[0].time = 1.7e9 + 0.1;
  path[1].time = 1.7e9 + 0.1 + 0.3;
  ASSERT_LT(path[1].time - path[0].time, 0.3 - 1e-8);
  EXPECT_EQ(frame_count(PathInterpolator(path), 1000.0), 301u);
}

TEST(Resample, SignsAreContinuous) {
  Path path = wandering_path(30, 0.02);
  for (std::size_t i = 0; i < path.size(); i += 2) path[i].pose.rotation.coeffs() *= -1.0;
  const Path frames = resample(PathInterpolator(path), 1000.0);
  for (std::size_t k = 1; k < frames.size(); ++k)
    EXPECT_GT(frames[k].pose.rotation.dot(frames[k - 1].pose.rotation), 0.9) << k;
}

TEST(Resample, OnePoseIsOneFrame) {
  const Path frames = resample(PathInterpolator({at_position(3.0, Vec3(1, 2, 3))}), 1000.0);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].time, 3.0);
  EXPECT_EQ(frames[0].pose.translation, Vec3(1, 2, 3));
}

TEST(Resample, CallersMistakesAreRefused) {
  EXPECT_THROW(PathInterpolator(Path{}), std::invalid_argument);
  const PathInterpolator interpolator(wandering_path(3, 0.1));
  for (const double rate : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(resample(interpolator, rate), std::invalid_argument);
}

/// Poses every 10 ms along x at 1 m/s, none for 3 s, then again.
Path with_a_gap() {
  Path path;
  for (int i = 0; i < 20; ++i) path.push_back(at_position(0.01 * i, Vec3(0.01 * i, 0, 0)));
  for (int i = 0; i < 20; ++i) path.push_back(at_position(3.19 + 0.01 * i, Vec3(0.3, 0.01 * i, 0)));
  return path;
}

TEST(Interpolate, AGapIsHeldAndBothSidesKeepTheirOwnVelocity) {
  const PathInterpolator path(with_a_gap(), Interpolation::CUBIC, 10.0);
  ASSERT_EQ(path.gaps().size(), 1u);
  EXPECT_DOUBLE_EQ(path.gaps().front().start, 0.19);
  EXPECT_NEAR(path.gaps().front().duration, 3.0, 1e-12);
  EXPECT_NEAR(path.sample_interval(), 0.01, 1e-12);
  for (const double time : {0.1901, 1.0, 3.1899})
    EXPECT_EQ(path.at(time).translation, Vec3(0.19, 0, 0)) << time;
  EXPECT_NEAR(velocity(path, 0.185, 1e-6).x(), 1.0, 1e-6);
  EXPECT_NEAR(velocity(path, 3.195, 1e-6).y(), 1.0, 1e-6);
  EXPECT_NEAR(velocity(path, 3.195, 1e-6).x(), 0.0, 1e-6);
}

TEST(Interpolate, GapsAreInterpolatedWhereNobodyAsksForThem) {
  const PathInterpolator path(with_a_gap());
  EXPECT_TRUE(path.gaps().empty());
  EXPECT_NE(path.at(1.0).translation, Vec3(0.19, 0, 0));
  EXPECT_TRUE(PathInterpolator(wandering_path(40, 0.02), Interpolation::LINEAR, 10.0).gaps().empty());
}

}  // namespace
}  // namespace lmdbench
