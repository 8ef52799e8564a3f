// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/local_tracking.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/triangle_pair.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/methods/improved/improved.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <map>

namespace lmdbench {
namespace {

using testing::make_scene;

bool holds(const LmdSet& set, const Lmd& lmd) {
  return std::any_of(set.begin(), set.end(), [&](const Lmd& other) { return same_feature_pair(other, lmd); });
}

ImprovedOptions with(Visibility visibility, Reduction reduction) {
  ImprovedOptions options;
  options.visibility = visibility;
  options.reduction = reduction;
  return options;
}

class ImprovedTest : public ::testing::Test {
 protected:
  /// Calls `body(scene, pose, truth)` on grazing poses of several mesh pairs.
  template <class Visit>
  void on_poses(int samples, Visit&& visit) {
    std::mt19937_64 random(21);
    for (const TriangleMesh& mesh : {make_blob(0.05, 0.012, 3), make_torus(0.05, 0.02, 24, 12),
                                     make_needles(0.05, 0.1, 12), make_unequal(0.05, 8, 30.0)}) {
      const Scene scene = make_scene(make_blob(0.04, 0.01, 4), mesh, 0.015);
      Exhaustive exhaustive(scene);
      for (int i = 0; i < samples; ++i) {
        const Pose pose = testing::grazing_pose(scene, 0.001, random);
        const LmdSet truth = lmds_at(exhaustive, pose);
        ASSERT_FALSE(truth.empty());
        visit(scene, pose, truth);
      }
    }
  }
  WorkCounters counters_;
};

TEST_F(ImprovedTest, CandidatesHoldEveryTrueLmdWhereNothingIsCulledByVisibility) {
  std::size_t count = 0;
  on_poses(10, [&](const Scene& scene, const Pose& pose, const LmdSet& truth) {
    LmdSet candidates;
    Improved(scene, with(Visibility::OFF, Reduction::PUBLISHED)).search(pose, candidates, counters_);
    for (const Lmd& lmd : truth) EXPECT_TRUE(holds(candidates, lmd));
    count += truth.size();
  });
  EXPECT_GT(count, 40u);
}

/// Decision E6, as measured: no visibility policy is conservative, and culling costs recall.
TEST_F(ImprovedTest, VisibilityCullsLeafPairsAndNeverAddsCandidates) {
  on_poses(3, [&](const Scene& scene, const Pose& pose, const LmdSet&) {
    LmdSet all, culled;
    WorkCounters work;
    Improved(scene, with(Visibility::OFF, Reduction::PUBLISHED)).search(pose, all, counters_);
    Improved(scene, with(Visibility::VERTEX_NORMAL, Reduction::PUBLISHED)).search(pose, culled, work);
    EXPECT_LE(culled.size(), all.size());
    EXPECT_EQ(work[Improved::Counter::LEAF_PAIRS],
              work[Improved::Counter::REJECTED_VISIBILITY] + work[Improved::Counter::TRIANGLE_DISTANCES]);
    for (const Lmd& lmd : culled)
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Lmd& other) {
        return other.triangle_moving == lmd.triangle_moving && other.triangle_fixed == lmd.triangle_fixed &&
               other.distance == lmd.distance;
      }));
  });
}

/// Boxes corner to corner: whole faces are beside each other.
TEST_F(ImprovedTest, EachVisibilityPolicyCullsOnCoarseMeshes) {
  const Scene scene = make_scene(make_box({0.1, 0.1, 0.1}), make_box({0.1, 0.1, 0.1}), 0.05);
  const Pose pose{Vec3(0.11, 0.12, 0.115)};
  const auto culled = [&](Visibility visibility) {
    LmdSet candidates;
    WorkCounters work;
    Improved(scene, with(visibility, Reduction::PUBLISHED)).search(pose, candidates, work);
    EXPECT_EQ(work[Improved::Counter::LEAF_PAIRS],
              work[Improved::Counter::REJECTED_VISIBILITY] + work[Improved::Counter::TRIANGLE_DISTANCES]);
    return work[Improved::Counter::REJECTED_VISIBILITY];
  };
  EXPECT_EQ(culled(Visibility::OFF), 0u);
  EXPECT_GT(culled(Visibility::VERTEX_NORMAL), 0u);
  EXPECT_GT(culled(Visibility::ORTHOGONAL), culled(Visibility::VERTEX_NORMAL)) << "the other reading of E6";
}

TEST_F(ImprovedTest, LossFreeReductionKeepsEachMinimumOnce) {
  on_poses(6, [&](const Scene& scene, const Pose& pose, const LmdSet& truth) {
    Improved improved(scene, with(Visibility::OFF, Reduction::LOSS_FREE));
    LmdSet lmds = lmds_at(improved, pose);
    improved.track(pose, lmds, counters_);
    for (const Lmd& lmd : truth) EXPECT_TRUE(holds(lmds, lmd));
    for (std::size_t i = 0; i < lmds.size(); ++i)
      for (std::size_t j = i + 1; j < lmds.size(); ++j) EXPECT_FALSE(same_feature_pair(lmds[i], lmds[j]));
  });
}

TEST_F(ImprovedTest, PublishedReductionKeepsASubsetWithTheNearestPair) {
  std::size_t kept = 0, before = 0;
  on_poses(6, [&](const Scene& scene, const Pose& pose, const LmdSet& truth) {
    Improved published(scene, with(Visibility::OFF, Reduction::PUBLISHED));
    Improved loss_free(scene, with(Visibility::OFF, Reduction::LOSS_FREE));
    LmdSet candidates = lmds_at(published, pose), all = candidates;
    before += candidates.size();
    published.track(pose, candidates, counters_);
    loss_free.track(pose, all, counters_);
    kept += candidates.size();
    EXPECT_LE(candidates.size(), all.size());
    for (const Lmd& lmd : candidates) EXPECT_TRUE(holds(all, lmd));
    ASSERT_FALSE(candidates.empty());
    EXPECT_NEAR(candidates[0].distance, truth[0].distance, 1e-15);
  });
  EXPECT_LT(kept * 4, before);  // a reduction worth its name
}

/// Decision E7, as measured: which LMDs the published rule loses depends on the order.
TEST_F(ImprovedTest, ThePublishedReductionLosesLmdsInAnOrderThatIgnoresDistance) {
  std::size_t total = 0, nearest_first = 0, by_index = 0;
  on_poses(6, [&](const Scene& scene, const Pose& pose, const LmdSet& truth) {
    ImprovedOptions options = with(Visibility::OFF, Reduction::PUBLISHED);
    Improved first(scene, options);
    options.tracking_order = TrackingOrder::TRIANGLE_INDEX;
    Improved second(scene, options);
    LmdSet ordered = lmds_at(first, pose), unordered = ordered;
    first.track(pose, ordered, counters_);
    second.track(pose, unordered, counters_);
    total += truth.size();
    for (const Lmd& lmd : truth) {
      nearest_first += holds(ordered, lmd);
      by_index += holds(unordered, lmd);
    }
  });
  EXPECT_GE(nearest_first * 100, total * 98);
  EXPECT_LT(by_index * 100, total * 97);
}

/// Decision E7: the result depends on the set, not on its order.
TEST_F(ImprovedTest, TrackingDoesNotDependOnTheOrderOfTheSet) {
  std::mt19937_64 random(4);
  on_poses(4, [&](const Scene& scene, const Pose& pose, const LmdSet&) {
    Improved improved(scene, with(Visibility::VERTEX_NORMAL, Reduction::PUBLISHED));
    LmdSet first = lmds_at(improved, pose), second = first;
    std::shuffle(second.begin(), second.end(), random);
    improved.track(pose, first, counters_);
    improved.track(pose, second, counters_);
    testing::expect_same_lmds(first, second);
  });
}

TEST_F(ImprovedTest, TrackingFollowsAMotionToTheMinimaOfTheNewPose) {
  std::size_t followed = 0, total = 0;
  on_poses(6, [&](const Scene& scene, const Pose& pose, const LmdSet&) {
    Improved improved(scene, with(Visibility::OFF, Reduction::LOSS_FREE));
    LmdSet lmds, truth;
    improved.search(pose, lmds, counters_);
    improved.track(pose, lmds, counters_);
    Pose moved = pose;
    moved.translation += Vec3(1e-4, -5e-5, 5e-5);
    moved.rotation = Eigen::AngleAxisd(1e-3, Vec3::UnitZ()) * moved.rotation;
    improved.track(moved, lmds, counters_);
    Exhaustive(scene).search(moved, truth, counters_);
    for (const Lmd& lmd : truth) {
      if (lmd.intersecting || lmd.distance > 0.9 * scene.cutoff)
        continue;  // it may be within the cutoff only now
      ++total;
      if (holds(lmds, lmd)) ++followed;
    }
    for (const Lmd& lmd : lmds) EXPECT_NEAR(lmd.distance, (lmd.point_fixed - lmd.point_moving).norm(), 1e-12);
  });
  EXPECT_GT(total, 25u);
  EXPECT_GE(static_cast<double>(followed), 0.9 * static_cast<double>(total));
}

/// Of pairs at one distance the one that is there stays: what the reduction left stays, too.
TEST_F(ImprovedTest, FlatGridsAtRestKeepTheirLmds) {
  const TriangleMesh slab = make_box({0.08, 0.08, 0.01}, {8, 8, 1});
  const Scene scene = make_scene(slab, slab, 0.005);
  const Pose pose{Vec3(0.0, 0.0, 0.012)};
  for (const Reduction reduction : {Reduction::PUBLISHED, Reduction::LOSS_FREE}) {
    Improved improved(scene, with(Visibility::OFF, reduction));
    LmdSet lmds = lmds_at(improved, pose);
    improved.track(pose, lmds, counters_);
    const LmdSet first = lmds;
    EXPECT_GE(first.size(), 2u);
    for (int frame = 0; frame < 3; ++frame) {
      improved.track(pose, lmds, counters_);
      testing::expect_like_lmds(lmds, first, 0.0);
    }
  }
}

TEST_F(ImprovedTest, TheCacheSavesDistancesOfNeighbours) {
  on_poses(1, [&](const Scene& scene, const Pose& pose, const LmdSet&) {
    Improved improved(scene, with(Visibility::OFF, Reduction::PUBLISHED));
    WorkCounters work;
    LmdSet lmds = lmds_at(improved, pose);
    improved.track(pose, lmds, work);
    EXPECT_GT(work[Improved::Counter::CACHE_HITS], work[Improved::Counter::TRIANGLE_DISTANCES]);
  });
}

TEST_F(ImprovedTest, APlainCacheGivesTheSameSetsForTheSameWork) {
  on_poses(4, [&](const Scene& scene, const Pose& pose, const LmdSet&) {
    ImprovedOptions options = with(Visibility::VERTEX_NORMAL, Reduction::PUBLISHED);
    Improved usual(scene, options);
    options.plain_cache = true;
    Improved plain(scene, options);
    LmdSet first = lmds_at(usual, pose), second = first;
    for (int update = 0; update < 2; ++update) {  // the first update must leave nothing
      WorkCounters one, other;
      usual.track(pose, first, one);
      plain.track(pose, second, other);
      EXPECT_EQ(one, other);
      testing::expect_same_lmds(first, second);
    }
  });
}

/// Decision E3: of overlapping meshes only the ablation rejects pairs that face away.
TEST_F(ImprovedTest, AClampedSigmaRejectsAmongOverlappingSpheres) {
  const Scene scene = make_scene(make_sphere(0.05, 2), make_sphere(0.05, 2), 0.01);
  const Pose pose{Vec3(0.09, 0.001, 0.002)};
  ImprovedOptions options = with(Visibility::OFF, Reduction::PUBLISHED);
  LmdSet lmds;
  WorkCounters usual, clamped;
  Improved(scene, options).search(pose, lmds, usual);
  options.clamped_sigma = true;
  Improved(scene, options).search(pose, lmds, clamped);
  EXPECT_GT(clamped[Improved::Counter::REJECTED_G3], usual[Improved::Counter::REJECTED_G3]);
}

/// Decision E11: trackings in the global thread.
TEST_F(ImprovedTest, SaysHowOftenItsSetIsTrackedInTheGlobalThread) {
  const Scene scene = make_scene(make_sphere(0.05, 1), make_sphere(0.05, 1), 0.01);
  ImprovedOptions options;
  EXPECT_EQ(Improved(scene, options).description().trackings_after_search, 2);
  options.second_tracking = false;
  EXPECT_EQ(Improved(scene, options).description().trackings_after_search, 1);
  EXPECT_EQ(Improved(scene, options).description().name, "improved");
}

/// Decision E2: the printed inequality of G3 keeps the wrong pairs, as leaves with spheres apart
/// show.
TEST_F(ImprovedTest, LiteralG3LosesAlmostEverything) {
  std::mt19937_64 random(22);
  const Scene scene = make_scene(make_blob(0.04, 0.01, 4), make_blob(0.05, 0.012, 4), 0.03);
  ImprovedOptions literal = with(Visibility::OFF, Reduction::PUBLISHED);
  literal.literal_g3 = true;
  std::size_t kept = 0, total = 0;
  for (int i = 0; i < 10; ++i) {
    const Pose pose = testing::grazing_pose(scene, 0.02, random);
    LmdSet truth, candidates;
    Exhaustive(scene).search(pose, truth, counters_);
    Improved(scene, literal).search(pose, candidates, counters_);
    for (const Lmd& lmd : truth) kept += holds(candidates, lmd);
    total += truth.size();
  }
  EXPECT_GT(total, 10u);
  EXPECT_LT(kept * 4, total);
}

/// Decision E12: a contact keeps the direction that it had when it was last apart.
TEST_F(ImprovedTest, AContactKeepsItsLastDirection) {
  const Scene scene = make_scene(make_sphere(0.05, 2), make_sphere(0.05, 2), 0.01);
  Improved improved(scene, with(Visibility::OFF, Reduction::LOSS_FREE));
  Pose pose{Vec3(0.101, 0.001, 0.002)};
  LmdSet lmds = lmds_at(improved, pose);
  improved.track(pose, lmds, counters_);
  ASSERT_FALSE(lmds.empty());
  const Vec3 apart = lmds[0].direction;
  EXPECT_NEAR(apart.norm(), 1.0, 1e-12);
  lmds.resize(1);
  pose.translation.x() = 0.098;
  improved.track(pose, lmds, counters_);
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].distance, 0.0);
  EXPECT_EQ(lmds[0].direction, apart);
}

/// A cone of 4 n triangles below its tip at the origin; its base is a square, so it needs no sine.
TriangleMesh hub(int n, double sign) {
  TriangleMesh mesh{.vertices = {Vec3::Zero()}, .triangles = {}};
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < n; ++i) {
      const double t = 2.0 * i / n - 1.0;
      const std::array<Vec3, 4> corners{Vec3(1, t, -1), Vec3(-t, 1, -1), Vec3(-1, -t, -1), Vec3(t, -1, -1)};
      mesh.vertices.push_back(corners[static_cast<std::size_t>(side)].cwiseProduct(Vec3(1, sign, sign)));
    }
  }
  const int around = 4 * n;
  for (int i = 0; i < around; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % around});
  return mesh;
}

/// L1 to L4 with the paper's cache; looks at every pair of triangles each time.
LmdSet track_without_memory(const Scene& scene, const Pose& pose, LmdSet lmds, bool published,
                            std::uint64_t& cache_hits) {
  const RigidTransform X_WM(pose);
  const Surface& moving = scene.moving->surface();
  const Surface& fixed = scene.fixed[0]->surface();
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<Lmd, int>> cache;
  LmdSet kept;
  std::sort(lmds.begin(), lmds.end(), lmd_less);
  std::uint64_t steps = 0;
  int number = 0;
  for (const Lmd& lmd : lmds) {
    const auto evaluate = [&](std::int32_t a, std::int32_t b) {
      const auto [entry, is_new] = cache.try_emplace({a, b});
      if (is_new)
        entry->second = {lmd_of_triangle_pair(moving, fixed, a, b,
                                              triangle_distance(X_WM.triangle(moving.mesh.triangle(a)),
                                                                fixed.mesh.triangle(b))),
                         number};
      cache_hits += !is_new;
      return TrackedPair{entry->second.first, published && entry->second.second != number};
    };
    const Lmd there = evaluate(lmd.triangle_moving, lmd.triangle_fixed).lmd;
    const WalkEnd end = walk_to_minimum(moving, fixed, lmd, there, evaluate, steps);
    ++number;
    if (!end.is_duplicate && (published || !holds(kept, end.lmd))) kept.push_back(end.lmd);
  }
  std::sort(kept.begin(), kept.end(), lmd_less);
  return kept;
}

TEST_F(ImprovedTest, WhatIsRememberedOfTwoHubsIsWhatEveryWalkFinds) {
  for (const Reduction reduction : {Reduction::PUBLISHED, Reduction::LOSS_FREE}) {
    const Scene scene = make_scene(hub(11, -1.0), hub(11, 1.0), 0.3);
    Pose pose{Vec3(0.03, 0.02, 0.05)};
    Improved improved(scene, with(Visibility::OFF, reduction));
    LmdSet lmds = lmds_at(improved, pose);
    EXPECT_GT(lmds.size(), 100U);
    // The cache is of one update, not of the one before.
    for (const double height : {0.05, 0.06}) {
      pose.translation.z() = height;
      SCOPED_TRACE(height);
      WorkCounters counters;
      std::uint64_t cache_hits = 0;
      const LmdSet expected =
          track_without_memory(scene, pose, lmds, reduction == Reduction::PUBLISHED, cache_hits);
      improved.track(pose, lmds, counters);
      ASSERT_EQ(lmds.size(), expected.size());
      ASSERT_FALSE(lmds.empty());
      for (std::size_t i = 0; i < lmds.size(); ++i) {
        EXPECT_EQ(lmds[i].distance, expected[i].distance);
        EXPECT_TRUE(same_feature_pair(lmds[i], expected[i]));
        EXPECT_EQ(lmds[i].triangle_moving, expected[i].triangle_moving);
        EXPECT_EQ(lmds[i].triangle_fixed, expected[i].triangle_fixed);
      }
      EXPECT_EQ(counters[Improved::Counter::CACHE_HITS], cache_hits);
    }
  }
}

/// 500 triangles each: 250,000 pairs, about as many candidates; walks would visit 4e10 pairs.
TEST_F(ImprovedTest, TwoHubsAreTrackedInTime) {
  const Scene scene = make_scene(hub(125, -1.0), hub(125, 1.0), 0.3);
  const Pose pose{Vec3(0.003, 0.002, 0.05)};
  Improved improved(scene);
  LmdSet lmds = lmds_at(improved, pose);
  EXPECT_GT(lmds.size(), 10'000U);
  const std::clock_t begin = std::clock();
  improved.track(pose, lmds, counters_);
  EXPECT_LT((std::clock() - begin) / CLOCKS_PER_SEC, 30) << "every walk looked at every pair";
  EXPECT_FALSE(lmds.empty());
}

}  // namespace
}  // namespace lmdbench
