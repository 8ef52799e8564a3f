// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/keep/traversal_front.h>

#include "methods/certified/traverse/wide_samples.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>
#include <utility>

namespace lmdbench {
namespace {

using testing::make_scene;

constexpr double CUTOFF = 0.05, TOUCH = 1e-9, ROUNDING = 1e-12;

/// Two bodies, one of which moves, with a front that lives from frame to frame.
class TraversalFrontTest : public ::testing::Test {
 protected:
  using Key = std::tuple<FeatureId, FeatureId, bool>;

  TraversalFrontTest() : scene_(make_scene(make_blob(0.5, 0.15, 3), make_torus(0.5, 0.2, 24, 12), CUTOFF)) {}

  const WideHierarchy& moving() const { return scene_.moving->prepared<WideHierarchy>(); }
  const WideHierarchy& fixed() const { return scene_.fixed[0]->prepared<WideHierarchy>(); }

  /// Brings forecast and front to the pose of the next frame.
  void go_to(const Pose& X_WM) {
    transform_ = RigidTransform(X_WM);
    RigidTransform X_WH = transform_;
    X_WH.translation = transform_.point(moving().origin);
    const WideQuery query(moving(), fixed(), transform_, CUTOFF, TOUCH);
    ASSERT_TRUE(query.possible);
    if (front_.empty()) {
      motion_.reset(X_WH, moving().radius, CUTOFF);
      front_.start(moving(), fixed());
    } else {
      motion_.advance(X_WH, ROUNDING);
    }
    due_ = front_.collect_due_tests(motion_, scratch_);
    front_.advance(moving(), fixed(), query, motion_, transform_, CUTOFF, due_ + most_, counters_, scratch_);
  }
  /// The pairs that are due; each gets this certificate.
  std::set<Key> due(const Certificate& certificate) {
    std::set<Key> keys;
    const auto decide = [&](const WidePair& pair, bool touches, double lever_arm) {
      EXPECT_GT(lever_arm, 2.0 * CUTOFF);
      EXPECT_TRUE(keys.emplace(pair.a.feature_id(), pair.b.feature_id(), touches).second) << "due twice";
      return certificate;
    };
    front_.collect_due(motion_, scratch_);
    front_.for_each_due(moving(), motion_, CUTOFF, scratch_, decide,
                        [](const WidePair&, bool) { return true; });
    return keys;
  }
  std::set<Key> from_scratch() const {
    const WideQuery query(moving(), fixed(), transform_, CUTOFF, TOUCH);
    WideScratch scratch;
    WideCounters ignored;
    find_wide_pairs(moving(), fixed(), query, WideKernel::SCALAR, scratch, ignored);
    std::set<Key> keys;
    for (const WidePair& pair : scratch.lmd_pairs)
      keys.emplace(pair.a.feature_id(), pair.b.feature_id(), false);
    for (const WidePair& pair : scratch.touch_pairs)
      keys.emplace(pair.a.feature_id(), pair.b.feature_id(), true);
    return keys;
  }

  Scene scene_;
  MotionForecast motion_;
  TraversalFront front_;
  TraversalFront::Scratch scratch_;
  RigidTransform transform_;
  std::size_t most_ = 1'000'000, due_ = 0;  ///< Tests a frame: other than due ones, and due ones.
  WideCounters counters_;
};

TEST_F(TraversalFrontTest, HoldsEveryPairOfASearchFromScratchAlongAnyMotion) {
  std::mt19937_64 random(17);
  std::size_t pairs = 0;
  for (int path = 0; path < 12; ++path) {
    front_.clear();
    Pose pose = testing::grazing_pose(scene_, 0.02, random);
    Vec3 velocity = 1e-3 * testing::random_direction(random), spin = 1e-2 * testing::random_direction(random);
    for (int frame = 0; frame < 60; ++frame) {
      if (frame % 20 == 19) {  // the forecast is wrong
        velocity = 4e-3 * testing::random_direction(random);
        spin = 3e-2 * testing::random_direction(random);
      }
      pose.translation += velocity;
      pose.rotation = Eigen::AngleAxisd(spin.norm(), spin.normalized()) * pose.rotation;
      const WideQuery query(moving(), fixed(), RigidTransform(pose), CUTOFF, TOUCH);
      if (!query.possible) break;
      go_to(pose);
      // With an empty certificate every pair of the front is due in every frame.
      const std::set<Key> held = due({}), wanted = from_scratch();
      EXPECT_EQ(held.size(), front_.pair_count());
      EXPECT_TRUE(std::includes(held.begin(), held.end(), wanted.begin(), wanted.end()))
          << "path " << path << ", frame " << frame;
      pairs += wanted.size();
    }
  }
  EXPECT_GT(pairs, 10000u) << "or there was little to miss";
}

TEST_F(TraversalFrontTest, MadeOverSeveralFramesItHoldsEveryPairAsSoonAsItIsComplete) {
  std::mt19937_64 random(22);
  for (int path = 0; path < 6; ++path) {
    most_ = path % 2 == 0 ? 1 : 16;
    front_.clear();
    Pose pose = testing::grazing_pose(scene_, 0.02, random);
    const Vec3 velocity = 2e-4 * testing::random_direction(random);
    int frames = 0;
    for (; frames < 1000 && !front_.is_complete(); ++frames) {
      pose.translation += velocity;
      const std::uint64_t before = counters_.node_tests;
      go_to(pose);
      EXPECT_LE(counters_.node_tests - before, most_ + due_);
      front_.collect_due(motion_, scratch_);
      front_.postpone_due(motion_, scratch_);
    }
    EXPECT_GT(frames, 10);
    ASSERT_LT(frames, 1000);
    go_to(pose);
    const std::set<Key> held = due({}), wanted = from_scratch();
    EXPECT_GT(wanted.size(), 0u);
    EXPECT_EQ(held.size(), front_.pair_count()) << "each is still to be decided";
    EXPECT_TRUE(std::includes(held.begin(), held.end(), wanted.begin(), wanted.end())) << "path " << path;
  }
}

TEST_F(TraversalFrontTest, RestRepeatsFewTests) {
  std::mt19937_64 random(18);
  const Pose pose = testing::grazing_pose(scene_, 0.02, random);
  const auto rest = [&](int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      go_to(pose);
      due({});
    }
    return counters_.node_tests;
  };
  // The forecast learns from the first frames.
  const std::uint64_t before = rest(30), repeated = rest(30) - before;
  EXPECT_GT(front_.test_count(), 10u);
  EXPECT_LE(repeated, 3 * front_.test_count()) << "in 30 frames";
  go_to(pose);
  const std::set<Key> held = due({}), wanted = from_scratch();
  EXPECT_TRUE(std::includes(held.begin(), held.end(), wanted.begin(), wanted.end()));
}

TEST_F(TraversalFrontTest, ADecisionStandsUntilItsSlackIsUsedUp) {
  std::mt19937_64 random(19);
  Pose pose = testing::grazing_pose(scene_, 0.02, random);
  const Certificate stands = Certificate::turned(0.05);
  go_to(pose);
  const std::size_t all = due(stands).size();
  ASSERT_GT(all, 0u);
  std::size_t decided = 0;
  for (int frame = 0; frame < 30; ++frame) {
    go_to(pose);
    decided += due(stands).size();
  }
  EXPECT_LT(decided, 6 * all) << "in 30 frames without a turn";
  // A turn in one frame by twice what the decisions allow, about the mesh's own origin.
  const Vec3 origin_W = RigidTransform(pose).point(moving().origin);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.1, Vec3::UnitZ()));
  pose.rotation = turn * pose.rotation;
  pose.translation = origin_W + turn * (pose.translation - origin_W);
  go_to(pose);
  const std::set<Key> again = due({}), wanted = from_scratch();
  EXPECT_TRUE(std::includes(again.begin(), again.end(), wanted.begin(), wanted.end()));
}

TEST_F(TraversalFrontTest, ATurnUsesUpADecisionByHowFarItMovesThePairAndByItsLeverArm) {
  std::mt19937_64 random(21);
  Pose pose = testing::grazing_pose(scene_, 0.02, random);
  go_to(pose);
  const double reach = motion_.extent(), slack = 0.064 * reach;
  // The lever arm alone allows a deviation of the slack; the distance from the origin, 0.6 of it.
  const Certificate stands = {
      .slack = slack, .gradient = Vec3::UnitX(), .spread = 0.0, .lever_arm = reach, .turn = 1.0};
  for (int frame = 0; frame < 4; ++frame) {
    due(stands);
    go_to(pose);
  }
  EXPECT_LT(due(stands).size(), front_.pair_count()) << "at rest they stand";
  const Vec3 origin_W = RigidTransform(pose).point(moving().origin);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.0425, Vec3::UnitZ()));
  pose.rotation = turn * pose.rotation;
  pose.translation = origin_W + turn * (pose.translation - origin_W);
  const std::size_t epoch = motion_.epoch();
  go_to(pose);
  ASSERT_LT(motion_.deviation(epoch), 0.98 * slack);
  ASSERT_GT(motion_.deviation(epoch), 0.8 * slack);
  const std::set<Key> again = due(stands);
  EXPECT_EQ(again.size(), front_.pair_count());
}

TEST_F(TraversalFrontTest, ForgetsWhatIsLeftBehind) {
  std::mt19937_64 random(20);
  Pose pose = testing::grazing_pose(scene_, 0.02, random);
  go_to(pose);
  ASSERT_GT(front_.pair_count(), 0u);
  const std::size_t tests = front_.test_count();
  // Away from the fixed mesh, as far as the bounding spheres still allow a pair.
  const Vec3 away = (pose.translation - fixed().origin).normalized();
  for (int frame = 0; frame < 200; ++frame) {
    pose.translation += 2e-3 * away;
    if (!WideQuery(moving(), fixed(), RigidTransform(pose), CUTOFF, TOUCH).possible) break;
    go_to(pose);
    due({});
  }
  EXPECT_EQ(front_.pair_count(), from_scratch().size());
  EXPECT_LT(front_.test_count(), tests);
  front_.clear();
  EXPECT_TRUE(front_.empty());
  EXPECT_EQ(front_.pair_count(), 0u);
}

}  // namespace
}  // namespace lmdbench
