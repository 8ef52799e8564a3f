// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/plateau.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

constexpr double HEIGHT = 0.25;

/// A patch of four triangles in a row, above another one; minima are made by hand.
class PlateauTest : public ::testing::Test {
 protected:
  PlateauTest() {
    // Vertices 0 2 4 above, 1 3 5 below; triangles share the edges between.
    TriangleMesh strip;
    strip.vertices = {{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 1, 0}, {2, 0, 0}};
    strip.triangles = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}};
    scene_ = testing::make_scene(strip, strip, 1.0);
  }

  static LocalMinimum face_pair(std::int32_t moving, std::int32_t fixed, const Vec3& p, double area,
                                double distance = HEIGHT) {
    LocalMinimum minimum;
    minimum.lmd.feature_moving = {FeatureKind::FACE, moving};
    minimum.lmd.feature_fixed = {FeatureKind::FACE, fixed};
    minimum.lmd.triangle_moving = moving;
    minimum.lmd.triangle_fixed = fixed;
    minimum.lmd.point_moving = p + Vec3(0, 0, distance);
    minimum.lmd.point_fixed = p;
    minimum.lmd.distance = distance;
    minimum.lmd.direction = -Vec3::UnitZ();
    minimum.dimension = 2;
    minimum.measure = area;
    return minimum;
  }
  LmdSet merged(std::vector<LocalMinimum> minima) const {
    LmdSet lmds;
    std::vector<Intersection> intersections;
    RigidTransform X_WM;
    X_WM.translation.z() = HEIGHT;
    merge_plateaus(scene_, X_WM, minima, intersections, lmds);
    return lmds;
  }

  Scene scene_;
};

TEST_F(PlateauTest, NeighboursOfEqualDistanceAreOneLmdAtTheirCentroid) {
  const LmdSet lmds = merged({face_pair(0, 0, {0.2, 0.6, 0}, 3.0), face_pair(1, 0, {0.8, 0.4, 0}, 1.0)});
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_TRUE(lmds[0].point_fixed.isApprox(Vec3(0.35, 0.55, 0), 1e-12)) << "weighted by area";
  EXPECT_TRUE(lmds[0].point_moving.isApprox(Vec3(0.35, 0.55, HEIGHT), 1e-12));
  EXPECT_DOUBLE_EQ(lmds[0].distance, HEIGHT);
  EXPECT_EQ(lmds[0].feature_moving.index, 0) << "the first face at the centroid";
}

TEST_F(PlateauTest, PiecesAreJoinedThroughOthers) {
  // Faces 0 and 3 share no corner; 1 and 2 link them.
  const std::vector<LocalMinimum> chain{
      face_pair(0, 0, {0.3, 0.6, 0}, 1.0), face_pair(3, 3, {1.7, 0.4, 0}, 1.0),
      face_pair(1, 1, {0.7, 0.4, 0}, 1.0), face_pair(2, 2, {1.3, 0.6, 0}, 1.0)};
  EXPECT_EQ(merged(chain).size(), 1u);
  EXPECT_EQ(merged({chain[0], chain[1]}).size(), 2u) << "the ends alone do not touch";
}

TEST_F(PlateauTest, APointIsJoinedAlongAnEdgeAsFarAsThatFacesTheOtherMesh) {
  // Of the second sheet only the edge from the first one's corner (1, 1) to the point (1.5, 0.5) is in the plane.
  scene_.moving = testing::make_body("moving", [] {
    TriangleMesh tent;
    tent.vertices = {{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 0.5}, {2, 1, 0.5}, {1.5, 0.5, 0}};
    tent.triangles = {{0, 1, 2}, {2, 1, 3}, {2, 3, 5}, {5, 3, 4}};
    return tent;
  }());
  const LocalMinimum face = face_pair(0, 0, {0.3, 0.6, 0}, 1.0);
  LocalMinimum point = face_pair(2, 2, {1.5, 0.5, 0}, 0.0);
  point.lmd.feature_moving = {FeatureKind::VERTEX, 5};
  point.dimension = 0;
  EXPECT_EQ(merged({face, point}).size(), 1u);
  // Another mesh below, whose triangles share a corner too, but not the one that the edge comes from.
  scene_.fixed = {testing::make_body("fixed", [] {
    TriangleMesh fan;
    fan.vertices = {{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1.6, 0.4, 0}, {1.5, 0.6, 0}};
    fan.triangles = {{0, 1, 2}, {1, 3, 4}};
    return fan;
  }())};
  point.lmd.feature_fixed.index = point.lmd.triangle_fixed = 1;
  EXPECT_EQ(merged({face, point}).size(), 2u);
}

TEST_F(PlateauTest, AnotherDistanceOrDirectionIsAnotherLmd) {
  const LocalMinimum first = face_pair(0, 0, {0.3, 0.6, 0}, 1.0);
  EXPECT_EQ(merged({first, face_pair(1, 1, {0.7, 0.4, 0}, 1.0, HEIGHT * (1.0 + 1e-6))}).size(), 2u);
  EXPECT_EQ(merged({first, face_pair(1, 1, {0.7, 0.4, 0}, 1.0, HEIGHT * (1.0 + 1e-10))}).size(), 1u);
  LocalMinimum tilted = face_pair(1, 1, {0.7, 0.4, 0}, 1.0);
  tilted.lmd.point_moving.x() += 1e-6 * HEIGHT;
  EXPECT_EQ(merged({first, tilted}).size(), 2u);
  tilted.lmd.point_moving.x() = 0.7 + 2e-9 * HEIGHT;  // Within PARALLEL_TILT.
  EXPECT_EQ(merged({first, tilted}).size(), 1u);
  LocalMinimum touching = first;
  touching.lmd.feature_fixed.index = 1;
  touching.lmd.intersecting = true;
  EXPECT_EQ(merged({first, touching}).size(), 2u) << "a pair apart and one that intersects";
}

TEST_F(PlateauTest, OtherBodiesAreOtherPlateaus) {
  scene_.fixed.push_back(scene_.fixed[0]);
  LocalMinimum other = face_pair(1, 1, {0.7, 0.4, 0}, 1.0);
  other.lmd.fixed_body = 1;
  EXPECT_EQ(merged({face_pair(0, 0, {0.3, 0.6, 0}, 1.0), other}).size(), 2u);
}

TEST_F(PlateauTest, OnlyPiecesOfTheHighestDimensionWeigh) {
  LocalMinimum corner = face_pair(0, 0, {1.0, 0.0, 0}, 0.0);
  corner.lmd.feature_moving = {FeatureKind::VERTEX, 3};
  corner.dimension = 0;
  LocalMinimum side = face_pair(0, 0, {0.5, 0.5, 0}, 100.0);
  side.lmd.feature_moving = {FeatureKind::EDGE, scene_.moving->surface().adjacency.triangle_edges[1][0]};
  side.dimension = 1;
  const LmdSet lmds = merged({face_pair(1, 1, {0.7, 0.4, 0}, 0.5), corner, side});
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_TRUE(lmds[0].point_fixed.isApprox(Vec3(0.7, 0.4, 0), 1e-12));
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::FACE);
}

TEST_F(PlateauTest, NeedsAStrictPiece) {
  std::vector<LocalMinimum> minima{face_pair(0, 0, {0.3, 0.6, 0}, 1.0), face_pair(1, 1, {0.7, 0.4, 0}, 1.0)};
  for (LocalMinimum& minimum : minima) minimum.strict = false;
  EXPECT_TRUE(merged(minima).empty());
  minima[1].strict = true;
  EXPECT_EQ(merged(minima).size(), 1u);
}

TEST_F(PlateauTest, TheOrderOfTheMinimaDoesNotMatter) {
  std::vector<LocalMinimum> minima{face_pair(0, 0, {0.3, 0.6, 0}, 0.7), face_pair(1, 0, {0.6, 0.4, 0}, 0.3),
                                   face_pair(1, 1, {0.7, 0.4, 0}, 1.1), face_pair(2, 2, {1.3, 0.6, 0}, 0.9),
                                   face_pair(3, 3, {1.7, 0.4, 0}, 0.4, 2.0 * HEIGHT)};
  const LmdSet expected = merged(minima);
  EXPECT_EQ(expected.size(), 2u);
  EXPECT_LT(expected[0].distance, expected[1].distance) << "sorted";
  std::mt19937_64 random(6);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(minima.begin(), minima.end(), random);
    const LmdSet again = merged(minima);
    ASSERT_EQ(again.size(), expected.size());
    for (std::size_t k = 0; k < again.size(); ++k) {
      EXPECT_EQ(again[k].point_moving, expected[k].point_moving) << "bit for bit";
      EXPECT_TRUE(same_feature_pair(again[k], expected[k]));
    }
  }
}

TEST_F(PlateauTest, OneEntryAFeaturePairTheNearestThenTheLargest) {
  std::vector<LocalMinimum> minima{face_pair(0, 0, {0.1, 0.1, 0}, 1.0), face_pair(0, 0, {0.2, 0.1, 0}, 3.0),
                                   face_pair(0, 0, {0.3, 0.1, 0}, 9.0, 2.0 * HEIGHT)};
  minima[0].strict = minima[1].strict = false;
  keep_one_a_feature_pair(minima);
  ASSERT_EQ(minima.size(), 1u);
  EXPECT_DOUBLE_EQ(minima[0].measure, 3.0);
  EXPECT_TRUE(minima[0].strict) << "strictness is left to the one that stays";
}

}  // namespace
}  // namespace lmdbench
