// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/body_distance.h>

#include <gtest/gtest.h>
#include <support/poses.h>

namespace lmdbench::experiments {
namespace {

TEST(GrazingPoses, ReachTheGap) {
  const Body blob("blob", build_surface(make_blob(1.0, 0.2, 2)));
  const Body box("box", build_surface(make_box(Vec3(1.0, 2.0, 0.5))));
  constexpr double GAP = 0.01;
  for (const Pose& pose : grazing_poses(blob, box, GAP, 20, 5)) {
    const double distance = nearest_pair(blob, box, pose).distance;
    EXPECT_GE(distance, GAP * (1.0 - 1e-12));
    EXPECT_LE(distance, GAP * (1.0 + 2.0 * GAP_TOLERANCE));
  }
}

TEST(GrazingPoses, DependOnTheSeedAlone) {
  const Body box("box", build_surface(make_box(Vec3::Ones())));
  const std::vector<Pose> few = grazing_poses(box, box, 0.1, 3, 9);
  const std::vector<Pose> many = grazing_poses(box, box, 0.1, 5, 9);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].translation, many[i].translation);
    EXPECT_EQ(few[i].rotation.coeffs(), many[i].rotation.coeffs());
  }
  EXPECT_NE(grazing_poses(box, box, 0.1, 1, 10)[0].translation, few[0].translation);
}

TEST(Random, CoversTheSphereEvenly) {
  Random random(1);
  Vec3 direction_sum = Vec3::Zero();
  Vec3 rotated_sum = Vec3::Zero();
  constexpr int COUNT = 20000;
  for (int i = 0; i < COUNT; ++i) {
    const Vec3 direction = random.direction();
    EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
    direction_sum += direction;
    rotated_sum += random.rotation() * Vec3::UnitX();
  }
  // Length of the mean of COUNT unit vectors: five standard deviations of about 1 / sqrt(COUNT).
  EXPECT_LT((direction_sum / COUNT).norm(), 5.0 / std::sqrt(COUNT));
  EXPECT_LT((rotated_sum / COUNT).norm(), 5.0 / std::sqrt(COUNT));
}

}  // namespace
}  // namespace lmdbench::experiments
