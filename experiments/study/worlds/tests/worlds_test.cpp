// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>

#include <gtest/gtest.h>
#include <study/worlds/broad_phases.h>
#include <study/worlds/completeness.h>
#include <study/worlds/cost.h>
#include <study/worlds/pile.h>

#include <cmath>
#include <memory>

namespace lmdbench::worlds {
namespace {

TEST(Worlds, AreAllLookedAtAndComplete) {
  constexpr std::size_t FRAMES = 600;
  std::size_t worlds = 0;
  for (const World& world : small_worlds(FRAMES, 1)) {
    ASSERT_EQ(world.poses.size(), FRAMES);
    EXPECT_TRUE(world.scene.is_world());
    const completeness::Judgement judgement = judge_world(
        world, 0.05, [&](const std::string& what) { ADD_FAILURE() << world.name << ": " << what; });
    EXPECT_EQ(judgement.poses, FRAMES);
    EXPECT_GT(judgement.same.true_lmds, 20u) << world.name;
    ++worlds;
  }
  EXPECT_EQ(worlds, 6u);
}

TEST(Plays, AreAllLookedAtAndComplete) {
  constexpr std::size_t FRAMES = 60;
  std::size_t plays = 0;
  for (const Play& play : small_plays(FRAMES, 1)) {
    ASSERT_EQ(play.frames.size(), FRAMES);
    for (const auto& poses : play.frames) ASSERT_EQ(poses.size(), play.movers.size());
    const completeness::Judgement judgement =
        judge_play(play, 0.05, [&](const std::string& what) { ADD_FAILURE() << play.name << ": " << what; });
    EXPECT_EQ(judgement.poses, FRAMES);
    EXPECT_GT(judgement.same.true_lmds, 100u) << play.name;
    ++plays;
  }
  EXPECT_EQ(plays, 4u);
}

TEST(Piles, AreMeasuredInEveryMotion) {
  PileChoice choice;
  choice.counts = {10, 40};
  choice.subdivisions = 2;
  choice.cutoff = 0.005;  // coarse faces are nearer to the centre than corners
  choice.looseness = 0.1;
  choice.stirring_speed = 1.0;
  choice.frames = 60;
  choice.passes = 2;
  for (const PileMotion motion : {PileMotion::JOSTLING, PileMotion::SETTLING, PileMotion::STIRRED}) {
    const std::vector<PileRow> rows = measure_piles(motion, choice);
    ASSERT_EQ(rows.size(), 2u);
    for (const PileRow& row : rows) {
      EXPECT_EQ(row.triangles, 320u);
      ASSERT_EQ(row.seconds.size(), 60u);
      EXPECT_GT(row.seconds_per_contact_pair(), 0.0) << to_string(motion);
      EXPECT_GE(row.searched, row.lmds);  // a sphere has one LMD
      EXPECT_GT(row.methods, 0u);
      EXPECT_GT(row.bytes, 0.0);
      EXPECT_EQ(row.frames_above(1e9), 0u);
      EXPECT_EQ(row.frames_above(0.0), 60u);
    }
    const std::vector<std::size_t>& pairs = rows[1].contact_pairs;
    if (motion == PileMotion::JOSTLING) {
      EXPECT_GT(pairs.front(), 60u);  // each has three others and more
      EXPECT_EQ(rows[1].anchored, 0.0);
    }
    if (motion == PileMotion::SETTLING) {
      EXPECT_EQ(pairs.front(), 0u);
      EXPECT_GT(pairs.back(), 60u);
    }
    if (motion == PileMotion::STIRRED) {
      EXPECT_GT(rows[1].anchored, 0.0);
    }
  }
}

TEST(Crowd, HasOneInTheMiddleAndFewerAreTheInnerOnes) {
  const auto mesh = std::make_shared<const Body>("box", build_surface(make_box({1.0, 1.0, 1.0})));
  const auto few = crowd(mesh, 20, 2.0, 1), many = crowd(mesh, 400, 2.0, 1);
  ASSERT_EQ(many.size(), 400u);
  EXPECT_FALSE(many[0].is_placed());
  for (std::size_t i = 0; i < few.size(); ++i)
    EXPECT_EQ(few[i].X_WF.translation, many[i].X_WF.translation) << i;
  for (std::size_t i = 1; i < many.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((many[i].X_WF.translation - many[j].X_WF.translation).norm(), 2.0 * std::sqrt(3.0) - 1e-9);
}

TEST(Crowd, CostsAreMeasuredForEverySize) {
  const auto mesh = std::make_shared<const Body>("sphere", build_surface(make_sphere(0.5, 2)));
  std::vector<Pose> poses(40);
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].translation = Vec3(1.01 - 1e-4 * static_cast<double>(i), 0.0, 0.0);
  CostChoice choice;
  choice.counts = {1, 30, 300};
  choice.passes = 1;
  for (const Frames frames : {Frames::COHERENT, Frames::FROM_SCRATCH, Frames::TELEPORT}) {
    const std::vector<CostRow> rows = measure_frames(mesh, mesh, 0.05, poses, frames, choice);
    ASSERT_EQ(rows.size(), 3u);
    for (const CostRow& row : rows) {
      EXPECT_EQ(row.frames, 40u);
      EXPECT_EQ(row.other_sets, 0u) << to_string(frames);
      EXPECT_EQ(row.seconds.size(), 40u);
      if (row.instances == 1) continue;
      EXPECT_EQ(row.searched, 1.0) << to_string(frames);
      EXPECT_EQ(row.idle_frames, 0u);
      if (frames == Frames::TELEPORT) {
        EXPECT_GT(row.queries, 0.5);
      } else {
        EXPECT_LE(row.queries, 0.05);
      }
    }
    // The work of the contact does not depend on the other instances.
    EXPECT_NEAR(rows[1].node_pairs, rows[2].node_pairs, 1e-9 + (frames == Frames::TELEPORT ? 1e9 : 0.0));
  }
  for (const PreparationRow& row : measure_preparation(mesh, mesh, 0.05, choice)) EXPECT_GT(row.bytes, 0.0);
}

TEST(BroadPhases, ReportEveryBoxWithinReach) {
  for (const BroadPhaseRow& row : compare_broad_phases(300, 200, 1, 1)) {
    EXPECT_EQ(row.wrong, 0u) << row.name;
    EXPECT_EQ(row.seconds.size(), 200u);
    EXPECT_GT(row.bytes, 0.0) << row.name;
  }
}

TEST(BroadPhases, ALargerSlackAsksLessOften) {
  const SlackRow little = measure_slack(0.02, 300, 400, 1, 1), much = measure_slack(0.5, 300, 400, 1, 1);
  EXPECT_GT(little.queries, 4.0 * much.queries);
}

}  // namespace
}  // namespace lmdbench::worlds
