// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/improved/improved.h>
#include <lmdbench/snch/traversal.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using LeafPairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

TEST(DualTraversal, ItsPlacesTogetherVisitWhatItVisitsInItsOrder) {
  const Scene scene = testing::make_scene(make_blob(0.04, 0.01, 4), make_torus(0.05, 0.02, 24, 12), 0.015);
  const Hierarchy& moving = scene.moving->prepared<Hierarchy>();
  const Hierarchy& fixed = scene.fixed[0]->prepared<Hierarchy>();
  std::mt19937_64 random(3);
  for (int sample = 0; sample < 5; ++sample) {
    const RigidTransform X_WM(testing::grazing_pose(scene, 0.001, random));
    DualTraversal traversal;
    LeafPairs whole;
    const auto add_to = [](LeafPairs& pairs) {
      return [&pairs](std::int32_t a, std::int32_t b) { pairs.emplace_back(a, b); };
    };
    const TraversalCounters all =
        traversal.run<DirectionTest::RAY>(moving, fixed, X_WM, scene.cutoff, add_to(whole));
    ASSERT_FALSE(whole.empty());
    for (const std::size_t wanted : {std::size_t{1}, std::size_t{7}, std::size_t{64}, std::size_t{1000000}}) {
      std::vector<DualTraversal::Place> places;
      TraversalCounters work =
          traversal.split<DirectionTest::RAY>(moving, fixed, X_WM, scene.cutoff, wanted, places);
      if (wanted <= 64) {
        EXPECT_GE(places.size(), wanted);
      }
      LeafPairs parts;
      for (const DualTraversal::Place& place : places)
        work +=
            traversal.run_below<DirectionTest::RAY>(place, moving, fixed, X_WM, scene.cutoff, add_to(parts));
      EXPECT_EQ(parts, whole) << wanted << " places wanted";
      EXPECT_EQ(work.node_pairs, all.node_pairs);
      EXPECT_EQ(work.rejected_g1 + work.rejected_g2 + work.rejected_g3,
                all.rejected_g1 + all.rejected_g2 + all.rejected_g3);
      EXPECT_EQ(work.leaf_pairs, all.leaf_pairs);
    }
  }
}

TEST(ImprovedSearchThreads, FindTheSameSetInTheSameOrderForTheSameWork) {
  const Scene scene = testing::make_scene(make_blob(0.04, 0.01, 4), make_blob(0.05, 0.012, 3), 0.015);
  std::mt19937_64 random(5);
  std::size_t candidates = 0;
  for (const std::int32_t threads : {2, 3, 8}) {
    ImprovedOptions options;
    Improved alone(scene, options);
    options.search_threads = threads;
    Improved team(scene, options);
    for (int sample = 0; sample < 6; ++sample) {
      // One pose is beyond the cutoff: no results to start from.
      Pose pose = testing::grazing_pose(scene, 0.001, random);
      if (sample == 3) pose.translation *= 10.0;
      LmdSet expected, found;
      WorkCounters work_alone, work_team;
      alone.search(pose, expected, work_alone);
      team.search(pose, found, work_team);
      EXPECT_EQ(work_team, work_alone);
      testing::expect_same_lmds(found, expected);
      candidates += found.size();
    }
  }
  EXPECT_GT(candidates, 100u);
}

}  // namespace
}  // namespace lmdbench
