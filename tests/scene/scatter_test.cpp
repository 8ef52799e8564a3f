// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/scene/scatter.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lmdbench {
namespace {

/// A box whose middle is not the origin of its frame.
const MeshBounds BOUNDS{Vec3(3.0, -1.0, 0.5), Vec3(0.3, 0.4, 1.2), 1.3};
const double DIAGONAL = 2.6;  // of the box above

std::vector<Vec3> middles(const std::vector<Pose>& poses) {
  std::vector<Vec3> all;
  for (const Pose& pose : poses) all.push_back(pose.translation + pose.rotation * BOUNDS.centre);
  return all;
}

double least_distance(const std::vector<Vec3>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (points[i] - points[j]).norm());
  return least;
}

TEST(Scatter, AGridHasItsSpacingAboutTheOrigin) {
  const std::vector<Pose> poses = scatter({.counts = {4, 3, 2}, .spacing = 1.5}, BOUNDS);
  ASSERT_EQ(poses.size(), 24u);
  const std::vector<Vec3> places = middles(poses);
  EXPECT_NEAR(least_distance(places), 1.5 * DIAGONAL, 1e-12);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& place : places) sum += place;
  EXPECT_LT(sum.norm(), 1e-11);
  EXPECT_NEAR(places.back().x(), 1.5 * 1.5 * DIAGONAL, 1e-12);
  EXPECT_NEAR(places.back().y(), 1.0 * 1.5 * DIAGONAL, 1e-12);
  EXPECT_NEAR(places.back().z(), 0.5 * 1.5 * DIAGONAL, 1e-12);
}

TEST(Scatter, RandomOnesFillACubeOfTheirDensity) {
  const std::vector<Pose> poses =
      scatter({.rule = Scatter::Rule::RANDOM, .count = 1000, .spacing = 0.5}, BOUNDS);
  ASSERT_EQ(poses.size(), 1000u);
  const double half = 0.5 * 10.0 * 0.5 * DIAGONAL;  // a thousand cubes of half a diagonal
  double farthest = 0.0;
  for (const Vec3& place : middles(poses)) farthest = std::max(farthest, place.cwiseAbs().maxCoeff());
  EXPECT_LT(farthest, half * (1.0 + 1e-12));
  EXPECT_GT(farthest, 0.95 * half);
}

TEST(Scatter, APileStandsOnTheFloorAndTouches) {
  const std::vector<Pose> poses =
      scatter({.rule = Scatter::Rule::PILE, .count = 200, .spacing = 1.0}, BOUNDS);
  const std::vector<Vec3> places = middles(poses);
  EXPECT_NEAR(least_distance(places), DIAGONAL, 1e-9);
  double lowest = 1e9, highest = 0.0;
  std::size_t on_floor = 0;
  for (const Vec3& place : places) {
    lowest = std::min(lowest, place.z());
    highest = std::max(highest, place.z());
    on_floor += place.z() < 1e-9 ? 1 : 0;
    // Every object but those on the floor lies on three others.
    if (place.z() < 0.1) continue;
    EXPECT_GE(std::count_if(places.begin(), places.end(),
                            [&](const Vec3& other) {
                              return other.z() < place.z() - 0.1 &&
                                     (other - place).norm() < DIAGONAL * (1.0 + 1e-9);
                            }),
              2);
  }
  EXPECT_NEAR(lowest, 0.0, 1e-9);
  EXPECT_GT(highest, 3.0 * DIAGONAL);
  EXPECT_GT(on_floor, 20u);
}

TEST(Scatter, TurnsEachByItselfAndTheSameInEveryRun) {
  const Scatter rule{.rule = Scatter::Rule::RANDOM, .count = 50};
  const std::vector<Pose> poses = scatter(rule, BOUNDS), again = scatter(rule, BOUNDS);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].translation, again[i].translation);
    EXPECT_NEAR(poses[i].rotation.norm(), 1.0, 1e-15);
    EXPECT_LT(std::abs(poses[i].rotation.dot(poses[(i + 1) % 50].rotation)), 0.9999);
  }
  for (const Pose& pose : scatter({.counts = {3, 3, 3}, .turned = false}, BOUNDS))
    EXPECT_EQ(pose.rotation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(Scatter, CountsThoseThatCoincide) {
  std::vector<Pose> poses = scatter({.counts = {3, 3, 3}}, BOUNDS);
  EXPECT_EQ(count_coincident(poses), 0u);
  poses.push_back(poses[4]);
  poses.push_back(poses[4]);
  poses.push_back(poses[7]);
  EXPECT_EQ(count_coincident(poses), 3u);
}

}  // namespace
}  // namespace lmdbench
