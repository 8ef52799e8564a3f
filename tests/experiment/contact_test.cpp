// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/contact.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/scenes.h>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;

Pose at(double x) {
  Pose pose;
  pose.translation = Vec3(x, 0.0, 0.0);
  return pose;
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

}  // namespace
}  // namespace lmdbench
