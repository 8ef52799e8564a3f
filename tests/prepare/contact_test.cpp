// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/placement.h>
#include <lmdbench/prepare/contact.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;

Pose at(double x) {
  return {Vec3(x, 0.0, 0.0)};
}

TEST(FramesInContact, AreThoseWithinTheCutoff) {
  const Scene scene = testing::make_scene(make_sphere(0.5, 3), make_sphere(0.5, 3), 0.05);
  EXPECT_THAT(frames_in_contact(scene, {at(1.051), at(1.0499), at(1.0), at(0.9), at(1.2)}),
              ElementsAre(false, true, true, true, false))
      << "touching and intersecting meshes are in contact, too";
}

TEST(FramesInContact, AnyFixedMeshCounts) {
  Scene scene = testing::make_scene(make_sphere(0.5, 3), make_sphere(0.5, 3), 0.05);
  TriangleMesh away = make_sphere(0.5, 3);
  for (Vec3& vertex : away.vertices) vertex.x() += 3.0;
  scene.fixed.push_back(testing::make_body("away", std::move(away)));
  EXPECT_THAT(frames_in_contact(scene, {at(1.04), at(1.5), at(1.96)}), ElementsAre(true, false, true));
}

TEST(FramesInContact, NoPoseNoFrame) {
  EXPECT_TRUE(
      frames_in_contact(testing::make_scene(make_sphere(0.5, 1), make_sphere(0.5, 1), 0.05), {}).empty());
}

/// A mesh that turns, in and out of the cutoff of two others, with steps of different lengths.
Scene two_others() {
  Scene scene =
      testing::make_scene(scaled_to_diagonal(make_box({1, 2, 2}), 3.0), make_torus(1.0, 0.4, 24, 12), 0.05);
  TriangleMesh away = make_sphere(0.5, 2);
  for (Vec3& vertex : away.vertices) vertex.x() += 5.0;
  scene.fixed.push_back(testing::make_body("away", std::move(away)));
  return scene;
}

std::vector<Pose> wandering() {
  std::mt19937_64 random(3);
  std::vector<Pose> poses;
  Pose pose = at(2.5);
  for (int k = 0; k < 3000; ++k) {
    const double step = std::pow(10.0, -4.0 + 3.0 * testing::uniform(random));
    pose.translation += step * testing::random_direction(random);
    pose.translation.x() = 2.75 + 1.3 * std::sin(0.004 * k) + step;
    pose.translation.y() = std::clamp(pose.translation.y(), -0.5, 0.5);
    pose.translation.z() = std::clamp(pose.translation.z(), -0.5, 0.5);
    pose.rotation =
        (pose.rotation * Eigen::Quaterniond(Eigen::AngleAxisd(step, testing::random_direction(random))))
            .normalized();
    poses.push_back(pose);
  }
  return poses;
}

TEST(FramesInContact, AForecastLeavesOutSearchesButNoContact) {
  const Scene scene = two_others();
  const std::vector<Pose> poses = wandering();
  const std::vector<bool> searched = frames_in_contact(scene, poses, false);
  EXPECT_EQ(frames_in_contact(scene, poses, true), searched);
  const auto contacts = std::count(searched.begin(), searched.end(), true);
  EXPECT_GT(contacts, 300);
  EXPECT_LT(contacts, 2700);
}

TEST(Clearance, IsTheExactDistanceHoweverFar) {
  const Scene scene = testing::make_scene(make_sphere(0.5, 3), make_sphere(0.5, 3), 0.01);
  EXPECT_NEAR(clearance(scene, {{at(1.75)}}).least_m, 0.75, 1e-12);
  EXPECT_EQ(clearance(scene, {{at(1.75)}}).touching, 0);
  EXPECT_EQ(clearance(scene, {{at(0.9)}}).least_m, 0.0);
  EXPECT_EQ(clearance(scene, {}).touching, 0);
}

/// Leaving out poses must change nothing: the least distance has the same bits, the count is equal.
TEST(Clearance, LeavesOutLooksButNoTouch) {
  const Scene scene = two_others();
  const std::vector<Pose> poses = wandering();
  Clearance each;
  std::vector<Pose> apart;
  for (const Pose& pose : poses) {
    const Clearance alone = clearance(scene, {{pose}});
    each.least_m = std::min(each.least_m, alone.least_m);
    each.touching += alone.touching;
    if (alone.touching == 0) apart.push_back(pose);
  }
  EXPECT_EQ(clearance(scene, poses).touching, each.touching);
  EXPECT_EQ(each.least_m, 0.0);
  EXPECT_GT(each.touching, 100);
  EXPECT_GT(apart.size(), 100u);

  double least = 1e9;
  for (const Pose& pose : apart) least = std::min(least, clearance(scene, {{pose}}).least_m);
  EXPECT_EQ(clearance(scene, apart).least_m, least);
  EXPECT_EQ(clearance(scene, apart).touching, 0);
}

}  // namespace
}  // namespace lmdbench
