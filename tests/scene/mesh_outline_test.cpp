// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <cmath>
#include <random>

namespace lmdbench {
namespace {

using testing::make_body;
using testing::random_direction;
using testing::random_rotation;
using testing::uniform;

TEST(MeshOutline, HoldsEveryTriangle) {
  for (const TriangleMesh& mesh :
       {make_torus(1.0, 0.3, 30, 12), make_needles(0.5, 2.0, 20), make_box({3, 1, 1})}) {
    const MeshOutline outline = MeshOutline::of(build_surface(TriangleMesh(mesh)));
    EXPECT_LE(outline.x.size(), OUTLINE_SPHERES);
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
      bool held = false;
      for (Eigen::Index i = 0; i < outline.x.size() && !held; ++i) {
        held = true;
        for (const Vec3& corner : mesh.triangle(t))
          held &= (corner - Vec3(outline.x[i], outline.y[i], outline.z[i])).norm() <= outline.radius[i];
      }
      EXPECT_TRUE(held) << "triangle " << t;
    }
  }
}

TEST(MeshOutline, IsNearerThanTheMeshesAndNotByMuch) {
  const auto moving = make_body("moving", make_blob(1.0, 0.3, 3)),
             fixed = make_body("fixed", make_torus(1.0, 0.3, 40, 16));
  const auto &a = moving->prepared<MeshOutline>(), &b = fixed->prepared<MeshOutline>();
  std::mt19937_64 random(9);
  int apart = 0, told = 0;
  for (int k = 0; k < 400; ++k) {
    Pose pose;
    pose.rotation = random_rotation(random);
    pose.translation = (1.5 + 2.5 * uniform(random)) * random_direction(random);
    const double exact = nearest_pair(*moving, *fixed, pose).distance;
    const double bound = outline_distance(a, b, RigidTransform(pose), 0.0);
    EXPECT_LE(bound, exact);
    apart += exact > 0.4 ? 1 : 0;
    told += bound > 0.0 && exact > 0.4 ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(10 * told, 9 * apart) << "a gap of a fifth of the diameter is told, nearly always";
}

TEST(MeshOutline, StopsWhereItIsNearEnough) {
  const auto mesh = make_body("mesh", make_sphere(0.5, 3));
  const auto& outline = mesh->prepared<MeshOutline>();
  const Pose pose{Vec3(1.5, 0.0, 0.0)};
  const double whole = outline_distance(outline, outline, RigidTransform(pose), -1.0);
  EXPECT_GT(whole, 0.2);
  EXPECT_LE(outline_distance(outline, outline, RigidTransform(pose), whole + 0.1), whole + 0.1);
  EXPECT_EQ(outline_distance(outline, outline, RigidTransform(pose), whole - 1e-9), whole);
}

TEST(MeshOutline, OfNoTriangleIsInfinitelyFar) {
  const MeshOutline none = MeshOutline::of(build_surface({}));
  EXPECT_EQ(none.x.size(), 0);
  EXPECT_TRUE(std::isinf(outline_distance(none, none, RigidTransform(), 0.0)));
}

}  // namespace
}  // namespace lmdbench
