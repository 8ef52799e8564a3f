// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/methods/nearest/nearest.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <random>

namespace lmdbench {
namespace {

/// A box of 0.2 m; its lowest corner is `gap` over a plate's upper face at z = 0.05.
Scene corner_over_plate(double cutoff) {
  return testing::make_scene(make_box({0.2, 0.2, 0.2}, 1), make_box({1.0, 1.0, 0.1}, 1), cutoff);
}

Pose on_corner(double gap) {
  const Vec3 corner = Vec3::Constant(-0.1);
  Pose pose;
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(corner, -Vec3::UnitZ());
  pose.translation = Vec3(0.17, 0.05, 0.05 + gap) - pose.rotation * corner;
  return pose;
}

TEST(Nearest, FindsACornerOverAFaceWithItsFeatures) {
  Nearest nearest(corner_over_plate(0.05));
  const LmdSet lmds = lmds_at(nearest, on_corner(0.01));
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_NEAR(lmds[0].distance, 0.01, 1e-12);
  EXPECT_NEAR((lmds[0].point_fixed - Vec3(0.17, 0.05, 0.05)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((lmds[0].direction + Vec3::UnitZ()).norm(), 0.0, 1e-9);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::FACE);
  EXPECT_EQ(lmds[0].feature_fixed.index, lmds[0].triangle_fixed);
  EXPECT_FALSE(lmds[0].intersecting);
}

TEST(Nearest, SeesNothingBeyondTheCutoff) {
  Nearest nearest(corner_over_plate(0.05));
  EXPECT_EQ(lmds_at(nearest, on_corner(0.0499)).size(), 1u);
  EXPECT_TRUE(lmds_at(nearest, on_corner(0.0501)).empty());
  EXPECT_EQ(lmds_at(nearest, on_corner(0.0499)).size(), 1u) << "and comes back";
}

TEST(Nearest, ContactHasDistanceZeroAndNoDirectionOfItsOwn) {
  Nearest nearest(corner_over_plate(0.05));
  const LmdSet lmds = lmds_at(nearest, on_corner(-0.01));
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].distance, 0.0);
  EXPECT_TRUE(lmds[0].intersecting);
  EXPECT_TRUE(lmds[0].point_moving.allFinite());
  EXPECT_TRUE(lmds[0].direction.array().isNaN().all());
}

/// The nearest pair is the first LMD of the true set, with the same features, wherever it is an
/// LMD. Along a motion: warm searches begin with the pair of a neighbouring frame.
TEST(Nearest, IsTheNearestOfTheTrueSet) {
  const Scene scene = testing::make_scene(make_blob(0.5, 0.1, 3), make_torus(0.5, 0.2, 32, 16), 0.1);
  Nearest warm(scene), cold(scene, NearestOptions{.warm_start = false});
  Exhaustive exhaustive(scene);
  std::mt19937_64 random(11);
  for (int start = 0; start < 6; ++start) {
    Pose pose = testing::grazing_pose(scene, 0.02, random);
    const Vec3 step = 0.002 * testing::random_direction(random);
    for (int frame = 0; frame < 5; ++frame) {
      pose.translation += step;
      const LmdSet truth = lmds_at(exhaustive, pose), found = lmds_at(warm, pose),
                   again = lmds_at(cold, pose);
      if (truth.empty() || truth.front().distance == 0.0) continue;
      ASSERT_EQ(found.size(), 1u);
      ASSERT_EQ(again.size(), 1u);
      EXPECT_NEAR(found[0].distance, truth.front().distance, 1e-9 * truth.front().distance);
      EXPECT_EQ(found[0].feature_moving, truth.front().feature_moving)
          << "start " << start << " frame " << frame;
      EXPECT_EQ(found[0].feature_fixed, truth.front().feature_fixed)
          << "start " << start << " frame " << frame;
      EXPECT_TRUE(same_feature_pair(found[0], again[0]));
      EXPECT_NEAR((found[0].point_fixed - found[0].point_moving).norm(), found[0].distance, 1e-15);
    }
  }
}

/// A scene of a centimetre: without scaling FCL overlooks faces and reports contact.
TEST(Nearest, SmallMeshesAreNoContact) {
  const Scene scene = testing::make_scene(make_blob(0.0005, 0.1, 4), make_blob(0.0005, 0.1, 4), 0.0001);
  Nearest nearest(scene);
  std::mt19937_64 random(3);
  for (int i = 0; i < 10; ++i) {
    const LmdSet lmds = lmds_at(nearest, testing::grazing_pose(scene, 0.00002, random));
    ASSERT_EQ(lmds.size(), 1u) << i;
    EXPECT_NEAR(lmds[0].distance, 0.00002, 1e-6 * 0.00002) << i;
  }
}

}  // namespace
}  // namespace lmdbench
