// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

#include <lmdbench/lmd/body_distance.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

namespace lmdbench {
namespace {

constexpr double TOLERANCE = 1e-9;

class Approach {
 public:
  explicit Approach(const Scene& scene) : scene_(scene) {}

  FirstApproach from(const Pose& pose, const Vec3& direction, double gap) const {
    return first_approach(moving(), fixed(), pose, direction, gap, TOLERANCE);
  }
  double distance(const Pose& pose) const { return nearest_pair(moving(), fixed(), pose).distance; }

 private:
  const Body& moving() const { return *scene_.moving; }
  const Body& fixed() const { return *scene_.fixed[0]; }
  Scene scene_;
};

TEST(FirstApproach, OfBoxesIsWhereTheirFacesAreAGapApart) {
  // Also gaps far above the sizes of the boxes: then the bounding spheres alone are not near.
  const Approach boxes(testing::make_scene(make_box({0.1, 0.1, 0.1}, 2), make_box({0.3, 0.3, 0.1}, 2), 1.0));
  for (const double gap : {1e-4, 0.05, 1.0, 20.0})
    EXPECT_NEAR(boxes.from({}, Vec3::UnitZ(), gap).displacement, 0.1 + gap, 2.0 * TOLERANCE * gap);
}

TEST(FirstApproach, IsAGapApartAndFartherEverywhereBeyond) {
  std::mt19937_64 random(5);
  const Approach shapes(testing::make_scene(make_blob(0.05, 0.01, 2), make_torus(0.05, 0.02, 16, 8), 1.0));
  int met = 0;
  for (const double gap : {1e-5, 1e-3, 0.03, 0.5}) {
    for (int i = 0; i < 20; ++i) {
      Pose pose{0.02 * testing::random_direction(random), testing::random_rotation(random)};
      const Vec3 start = pose.translation, direction = testing::random_direction(random);
      const double displacement = shapes.from(pose, direction, gap).displacement;
      if (!std::isfinite(displacement)) continue;  // Through the hole; see below.
      ++met;
      pose.translation = start + displacement * direction;
      EXPECT_NEAR(shapes.distance(pose), gap, 2.0 * TOLERANCE * gap);
      for (const double further : {1e-6, 1e-3, 0.01, 0.03, 0.1}) {
        pose.translation = start + (displacement + further) * direction;
        EXPECT_GT(shapes.distance(pose), gap) << further;
      }
    }
  }
  EXPECT_GT(met, 40);
}

TEST(FirstApproach, IsNoneWhereALinePassesWithoutComingNear) {
  // A small blob along the axis of a torus with a hole of 0.03.
  const Approach shapes(testing::make_scene(make_blob(0.005, 0.0, 2), make_torus(0.05, 0.02, 32, 16), 1.0));
  EXPECT_FALSE(std::isfinite(shapes.from({}, Vec3::UnitZ(), 0.02).displacement));
  EXPECT_TRUE(std::isfinite(shapes.from({}, Vec3::UnitZ(), 0.03).displacement));
}

}  // namespace
}  // namespace lmdbench
