// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

#include <gtest/gtest.h>
#include <study/completeness/hostile_meshes.h>
#include <study/completeness/hostile_scenes.h>
#include <support/parts/rest_fits.h>

#include <algorithm>
#include <set>
#include <string>

namespace lmdbench::completeness {
namespace {

TEST(HostileMeshes, AreBrokenInEveryWay) {
  experiments::Random random(1);
  std::set<std::string> histories;
  std::size_t open = 0, not_manifold = 0, degenerate = 0, inconsistent = 0, largest = 0;
  constexpr std::size_t MESHES = 400;
  for (std::size_t i = 0; i < MESHES; ++i) {
    const HostileMesh hostile = make_hostile_mesh(random);
    histories.insert(hostile.history);
    ASSERT_FALSE(hostile.mesh.triangles.empty()) << hostile.history;
    for (const Vec3& p : hostile.mesh.vertices) ASSERT_TRUE(p.allFinite()) << hostile.history;
    const ValidityReport report = check_mesh(build_surface(hostile.mesh));
    open += !report.closed;
    not_manifold += !report.manifold;
    degenerate += report.degenerate_triangles > 0;
    inconsistent += !report.consistently_oriented;
    largest = std::max(largest, hostile.mesh.triangles.size());
  }
  EXPECT_GT(histories.size(), MESHES / 2);
  for (const std::size_t count : {open, not_manifold, degenerate, inconsistent}) {
    EXPECT_GT(count, MESHES / 10);
    EXPECT_LT(count, MESHES - MESHES / 10);
  }
  EXPECT_LT(largest, 500u) << "exhaustive has to keep up";
}

TEST(HostileScenes, DependOnTheirArgumentsAlone) {
  for (const Motion motion : ALL_MOTIONS) {
    const GeneratedScene one = make_hostile_scene(motion, 2, 5), same = make_hostile_scene(motion, 2, 5),
                         other = make_hostile_scene(motion, 2, 6);
    EXPECT_EQ(one.label, same.label);
    EXPECT_EQ(one.poses.back().translation, same.poses.back().translation);
    EXPECT_NE(one.label, other.label);
    EXPECT_EQ(one.poses.size(), is_without_motion(motion) ? HOSTILE_POSES_A_SCENE : HOSTILE_FRAMES_A_SCENE);
  }
}

TEST(HostileScenes, PiecesThatCrossByTheToleranceHaveOneMiddle) {
  // Thin plates in floats, 1e-7 apart: of an LMD's pieces some cross by less than the tolerance.
  for (const std::size_t index : {6337u, 8969u}) {
    const GeneratedScene laid = make_hostile_scene(Motion::LAID, 20261130, index);
    Exhaustive exhaustive(laid.scene);
    std::size_t lmds = 0;
    for (const Pose& pose : laid.poses) {
      const LmdSet set = lmds_at(exhaustive, pose);
      EXPECT_TRUE(is_well_formed(set, laid.scene)) << laid.label;
      lmds += set.size();
    }
    EXPECT_GT(lmds, 20u);
  }
}

TEST(HostileScenes, AreSearchedWithoutLoss) {
  std::size_t lmds = 0;
  for (const Motion motion : ALL_MOTIONS) {
    std::string wrong;
    for (const Judgement& judgement :
         judge_hostile_scenes(motion, 7, 300, [&](const std::string& what) { wrong += what + "\n"; }))
      lmds += judgement.same.true_lmds;
    EXPECT_EQ(wrong, "") << name_of(motion);
  }
  EXPECT_GT(lmds, 7000u);
}

/// Copies turned by as little as the tolerance about a place where they touch, whose edges have no
/// sides, sides as short as rounding, or cross and are parallel to the tolerance: a pair of edges
/// had two LMDs.
TEST(HostileScenes, APairOfFeaturesHasOneLmd) {
  struct Found {
    std::uint64_t seed;
    std::size_t index, pose;
  };
  for (const Found& found :
       {Found{777, 162, 14}, {777, 1708, 17}, {777, 2980, 2}, {779, 2616, 18}, {20261128, 1562, 19}}) {
    const GeneratedScene hostile = make_hostile_scene(Motion::NONE, found.seed, found.index);
    Exhaustive exhaustive(hostile.scene);
    const LmdSet truth = lmds_at(exhaustive, hostile.poses[found.pose]);
    std::string objection;
    EXPECT_EQ(judge({}, truth, hostile.scene, hostile.scale, objection).duplicates, 0U) << hostile.label;
  }
}

void expect_right(std::uint64_t seed, std::size_t index, Motion motion = Motion::NONE) {
  std::string wrong;
  std::vector<Judgement> judgements(variants().size());
  judge_scene(
      make_hostile_scene(motion, seed, index), [&](const std::string& what) { wrong += what + "\n"; },
      judgements);
  EXPECT_EQ(wrong, "");
}

/// Meshes whose edges are as short as rounding of the other's coordinates.
TEST(HostileScenes, AMeshFarSmallerThanTheOtherLosesNothing) {
  expect_right(777, 9898);
  expect_right(779, 336);
}

/// A mesh in the place of its copy, with an edge of 1e-12 beside a triangle without area.
TEST(HostileScenes, AnEdgeWithOneNormalLosesNothing) {
  expect_right(202611272, 8895);
}

/// Edges beyond the tip of a needle that they run along were over it in one method.
TEST(HostileScenes, NeedlesEndAtTheirTips) {
  expect_right(41, 6759, Motion::LAID);
}

/// Of edges of folded needles the outer side is rounding.
TEST(HostileScenes, AnEdgeWhoseNormalsCancelLosesNothing) {
  expect_right(41, 9879, Motion::LAID);
}

TEST(HostileScenes, AContactOfShortPiecesApartHasItsMiddle) {
  // Squashed meshes share parts of 1e-9 of the size, far from each other: any middle is right.
  const GeneratedScene hostile = make_hostile_scene(Motion::NONE, 9141, 290);
  Certified certified(hostile.scene);
  Exhaustive exhaustive(hostile.scene);
  std::size_t contacts = 0;
  for (const Pose& pose : hostile.poses) {
    const LmdSet lmds = lmds_at(certified, pose), truth = lmds_at(exhaustive, pose);
    ASSERT_EQ(lmds.size(), truth.size());
    for (std::size_t i = 0; i < lmds.size(); ++i) {
      contacts += lmds[i].intersecting;
      EXPECT_LT((lmds[i].point_fixed - truth[i].point_fixed).norm(), 1e-12 * hostile.scale);
    }
  }
  EXPECT_GT(contacts, 20u);
}

/// Faces of parts that rest in each other are joined by what touches several of them.
TEST(HostileScenes, FacesOfACrossHalvingKeepTheirDirections) {
  for (const std::size_t index : {0, 6}) {
    const parts::RestScene scene = make_rest_scene(parts::rest_fit("cross halving"), 1, index);
    LmdSet lmds;
    WorkCounters counters;
    Exhaustive(scene.scene).search(scene.X_WM, lmds, counters);
    std::size_t demanded = 0;
    for (const parts::RestPlace& place : scene.places) {
      if (!place.demanded) continue;
      ++demanded;
      const Vec3 direction = scene.X_WD.rotation * place.direction;
      EXPECT_TRUE(std::ranges::any_of(
          lmds, [&](const Lmd& lmd) { return (lmd.direction - direction).norm() < 1e-6; }))
          << direction.transpose() << ": " << scene.text;
    }
    EXPECT_GE(demanded, 3u);
  }
}

}  // namespace
}  // namespace lmdbench::completeness
