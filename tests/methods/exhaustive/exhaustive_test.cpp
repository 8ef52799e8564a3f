// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/methods/exhaustive/feature_grid.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <support/polar_cone.h>
#include <support/scenes.h>

#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

namespace lmdbench {
namespace {

using testing::in_polar_cone;
using testing::make_scene;
using testing::moved;

LmdSet truth(const Scene& scene, const Pose& pose) {
  Exhaustive method(scene);
  return lmds_at(method, pose);
}

std::set<std::tuple<FeatureId, FeatureId>> feature_pairs(const LmdSet& lmds) {
  std::set<std::tuple<FeatureId, FeatureId>> pairs;
  for (const Lmd& lmd : lmds) pairs.emplace(lmd.feature_moving, lmd.feature_fixed);
  return pairs;
}

TEST(Exhaustive, TwoBoxesFaceToFaceAreOnePlateauAtTheCentreOfTheOverlap) {
  const Scene scene = make_scene(make_box({0.1, 0.1, 0.1}, 3), make_box({0.1, 0.1, 0.1}, 3), 0.05);
  const LmdSet lmds = truth(scene, moved(0.03, 0.02, 0.12));
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_NEAR(lmds[0].distance, 0.02, 1e-15);
  // The overlap is [-0.02, 0.05] x [-0.03, 0.05].
  EXPECT_LT((lmds[0].point_fixed - Vec3(0.015, 0.01, 0.05)).norm(), 1e-12);
  EXPECT_LT((lmds[0].point_moving - Vec3(0.015, 0.01, 0.07)).norm(), 1e-12);
  EXPECT_LT((lmds[0].direction - Vec3(0.0, 0.0, -1.0)).norm(), 1e-12);
}

TEST(Exhaustive, TwoBoxesCornerToCornerAreOneVertexPair) {
  const Scene scene = make_scene(make_box({0.1, 0.1, 0.1}), make_box({0.1, 0.1, 0.1}), 0.05);
  const LmdSet lmds = truth(scene, moved(0.11, 0.12, 0.13));
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::VERTEX);
  EXPECT_NEAR(lmds[0].distance, std::sqrt(0.01 * 0.01 + 0.02 * 0.02 + 0.03 * 0.03), 1e-15);
}

TEST(Exhaustive, TwoBoxesEdgeToEdgeInParallelAreOneSegment) {
  const Scene scene = make_scene(make_box({0.1, 0.1, 0.1}, 4), make_box({0.1, 0.1, 0.1}, 4), 0.05);
  const LmdSet lmds = truth(scene, moved(0.11, 0.12, 0.03));
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_NEAR(lmds[0].distance, std::hypot(0.01, 0.02), 1e-15);
  EXPECT_LT((lmds[0].point_fixed - Vec3(0.05, 0.05, 0.015)).norm(), 1e-12);
  EXPECT_LT((lmds[0].point_moving - Vec3(0.06, 0.07, 0.015)).norm(), 1e-12);
}

TEST(Exhaustive, CrossedWedgesAreOneEdgePair) {
  // The upper wedge is upside down and turned by 90 degrees: the sharp edges cross at right angles.
  const Scene scene = make_scene(make_wedge(0.1, 0.2, 0.05), make_wedge(0.1, 0.2, 0.05), 0.02);
  const double top = 0.5 * bounding_box_diagonal(scene.fixed[0]->surface().mesh);
  Pose pose;
  pose.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()) *
                  Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX());
  const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
  pose.translation = {0.013, 0.007, 2.0 * top};
  pose.translation.z() -= nearest_pair(moving, fixed, pose).distance - 0.01;
  const LmdSet lmds = truth(scene, pose);
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::EDGE);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::EDGE);
  EXPECT_NEAR(lmds[0].distance, 0.01, 1e-12);
}

TEST(Exhaustive, AReflexEdgeCarriesNothing) {
  // A small sphere in the notch of the L faces both arms, not the edge between them.
  const Scene scene = make_scene(make_sphere(0.002, 1), make_l_block(0.05), 0.012);
  int pairs = 0;
  for (double x = -0.024; x < 0.025; x += 0.006) {
    for (double z = -0.024; z < 0.025; z += 0.006) {
      for (const Lmd& lmd : truth(scene, moved(x, 0.001, z))) {
        if (lmd.intersecting) continue;
        ++pairs;
        EXPECT_EQ(lmd.feature_fixed.kind, FeatureKind::FACE) << x << ", " << z;
      }
    }
  }
  EXPECT_GT(pairs, 10);
}

/// The definition without the grid: every triangle pair, every corner of the incident triangles.
TEST(Exhaustive, EqualsTheLiteralDefinition) {
  std::size_t total = 0;
  std::mt19937_64 random(5);
  for (const TriangleMesh& mesh :
       {make_torus(0.05, 0.02, 20, 10), make_patch(0.1, 10, 0.02), make_unequal(0.05, 5, 30.0)}) {
    const Scene scene = make_scene(make_blob(0.04, 0.01, 2), mesh, 0.03);
    for (int sample = 0; sample < 6; ++sample) {
      const Pose pose = testing::grazing_pose(scene, 0.003, random);
      const RigidTransform transform(pose), identity;
      const Surface &moving = scene.moving->surface(), &fixed = scene.fixed[0]->surface();
      std::set<std::tuple<FeatureId, FeatureId>> expected;
      for (std::size_t a = 0; a < moving.mesh.triangles.size(); ++a) {
        for (std::size_t b = 0; b < fixed.mesh.triangles.size(); ++b) {
          const auto ta = static_cast<std::int32_t>(a), tb = static_cast<std::int32_t>(b);
          const TrianglePairDistance pair =
              triangle_distance(transform.triangle(moving.mesh.triangle(ta)), fixed.mesh.triangle(tb));
          if (pair.squared_distance > scene.cutoff * scene.cutoff) continue;
          const FeatureId on_moving = moving.feature_of(ta, pair.feature_a);
          const FeatureId on_fixed = fixed.feature_of(tb, pair.feature_b);
          const Vec3 d = pair.point_b - pair.point_a;
          const RigidTransform back(pose.inverse());
          if (in_polar_cone(moving, on_moving, back.point(pair.point_a), back.direction(d), 1e-10) &&
              in_polar_cone(fixed, on_fixed, pair.point_b, -d, 1e-10))
            expected.emplace(on_moving, on_fixed);
        }
      }
      total += expected.size();
      EXPECT_EQ(feature_pairs(truth(scene, pose)), expected);
    }
  }
  EXPECT_GT(total, 20u);
}

/// Tests the definition by sampling: no point of either surface near the pair's points is nearer to
/// the other surface.
TEST(Exhaustive, NoNeighbouringPointIsNearer) {
  std::mt19937_64 random(6);
  const Scene scene = make_scene(make_blob(0.04, 0.01, 2), make_torus(0.05, 0.02, 20, 10), 0.03);
  int checks = 0;
  for (int sample = 0; sample < 10; ++sample) {
    const Pose pose = testing::grazing_pose(scene, 0.003, random);
    const RigidTransform transform(pose);
    const Surface& moving = scene.moving->surface();
    for (const Lmd& lmd : truth(scene, pose)) {
      for (const std::int32_t t : moving.incident_triangles(lmd.feature_moving)) {
        const Triangle corners = transform.triangle(moving.mesh.triangle(t));
        for (int i = 0; i < 20; ++i) {
          const double u = testing::uniform(random), v = (1.0 - u) * testing::uniform(random);
          const Vec3 far = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
          EXPECT_GE((far - lmd.point_fixed).norm(), lmd.distance * (1.0 - 1e-9));
          ++checks;
        }
      }
    }
  }
  EXPECT_GT(checks, 500);
}

TEST(Exhaustive, HoldsTheMinimumDistanceAndIsSortedAndFreeOfDuplicates) {
  std::mt19937_64 random(8);
  const Scene scene = make_scene(make_blob(0.04, 0.01, 3), make_blob(0.05, 0.012, 3), 0.02);
  for (int sample = 0; sample < 10; ++sample) {
    const Pose pose = testing::grazing_pose(scene, 0.001, random);
    const LmdSet lmds = truth(scene, pose);
    ASSERT_FALSE(lmds.empty());
    const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
    EXPECT_NEAR(lmds[0].distance, nearest_pair(moving, fixed, pose).distance, 1e-15);
    EXPECT_TRUE(std::is_sorted(lmds.begin(), lmds.end(), lmd_less));
    EXPECT_EQ(feature_pairs(lmds).size(), lmds.size());
  }
}

TEST(Exhaustive, TouchingSurfacesGiveOneContactWithoutDirection) {
  const Scene scene = make_scene(make_sphere(0.05, 2), make_sphere(0.05, 2), 0.01);
  const LmdSet lmds = truth(scene, moved(0.09, 0.003, 0.002));
  ASSERT_FALSE(lmds.empty());
  EXPECT_TRUE(lmds[0].intersecting);
  EXPECT_EQ(lmds[0].distance, 0.0);
  EXPECT_TRUE(lmds[0].direction.hasNaN());
  EXPECT_EQ(std::count_if(lmds.begin(), lmds.end(), [](const Lmd& lmd) { return lmd.intersecting; }), 1);
}

TEST(Exhaustive, NearlyParallelFacesAreOneContactAtAnyTilt) {
  // From far below the tolerance of the first-order test to far above: whole overlap to corner.
  const Scene scene = make_scene(make_box({0.06, 0.06, 0.06}, 2), make_box({0.3, 0.3, 0.01}, 5), 0.005);
  for (int step = 0; step <= 60; ++step) {
    const double tilt = 1e-11 * std::pow(1.15, step);
    const Pose pose{Vec3(0.01, 0.02, 0.0355),
                    Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3(1.0, 0.3, 0.0).normalized()))};
    for (const char* name : {"exhaustive", "certified"}) {
      const LmdSet lmds = lmds_at(*make_method(name, scene), pose);
      EXPECT_EQ(lmds.size(), 1u) << name << ", tilt " << tilt;
    }
  }
}

/// Each box of a fan round one vertex covers much of it: a cell for each would take all memory.
TEST(FeatureGrid, LongBoxesTakeNoMoreThanTheirNumber) {
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0, 0.0, 1.0);
  constexpr std::int32_t COUNT = 10000;
  for (std::int32_t i = 0; i < COUNT; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / COUNT;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % COUNT});
  }
  FeatureGrid grid(build_surface(mesh));
  EXPECT_LE(grid.bytes(), 2000 * mesh.triangles.size());
  std::size_t found = 0;
  const Vec3 apex = mesh.vertices[0];
  grid.for_each_near(Eigen::AlignedBox3d(apex, apex), 1e-6, [&](const FeatureId&) { ++found; });
  EXPECT_EQ(found, 1u + 2u * COUNT) << "the vertex, its edges and triangles";
}

}  // namespace
}  // namespace lmdbench
