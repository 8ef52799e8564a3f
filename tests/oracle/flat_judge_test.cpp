// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <judge/flat_judge.h>
#include <support/parts/parts_scenes.h>
#include <support/parts/prism_complex.h>
#include <support/scenes.h>

#include <string>

namespace lmdbench::exact {
namespace {

using testing::moved;

constexpr double CUTOFF = 0.05;

LmdSet truth_of(const Scene& scene, const Pose& pose) {
  return lmds_at(*make_method("exhaustive", scene), pose);
}

/// A scene, its LMDs, and the judge's verdict on them.
class FlatJudgeTest : public ::testing::Test {
 protected:
  void set(TriangleMesh moving, TriangleMesh fixed, const Pose& pose) {
    scene_ = testing::make_scene(std::move(moving), std::move(fixed), CUTOFF);
    truth_ = std::make_unique<FlatTruth>(scene_.moving->surface(), scene_.fixed[0]->surface(), pose, CUTOFF);
    lmds_ = truth_of(scene_, pose);
  }
  FlatCounts judged() {
    objections_.clear();
    return truth_->judge(lmds_, objections_);
  }

  Scene scene_;
  std::unique_ptr<FlatTruth> truth_;
  LmdSet lmds_;
  std::string objections_;
};

TEST_F(FlatJudgeTest, ABoxOnATableIsOneContactInTheMiddle) {
  set(make_box({1.0, 1.0, 0.5}, 3), make_box({2.0, 2.0, 0.5}, 2), moved(0.625, 0.25, 0.5078125));
  EXPECT_EQ(truth_->demanded(), 1u);
  const FlatCounts counts = judged();
  EXPECT_EQ(objections_, "");
  EXPECT_EQ(counts.areas, 1u);
  EXPECT_EQ(counts.right, 1u);
  // The overlap is [.125, 1] x [-.25, .75].
  lmds_.at(0).point_fixed = Vec3(0.5625 + 1e-8, 0.25, 0.25);
  EXPECT_EQ(judged().misplaced, 1u) << objections_;
}

TEST_F(FlatJudgeTest, SeesWhatIsMissedDoubledAndUntrue) {
  // Two boxes beside each other: two overlaps.
  set(make_two_boxes({0.5, 1.0, 0.5}, 0.125), make_box({2.0, 2.0, 0.5}, 2), moved(0.0, 0.0, 0.5078125));
  ASSERT_EQ(truth_->demanded(), 2u);
  ASSERT_EQ(lmds_.size(), 2u);
  EXPECT_EQ(judged().right, 2u) << objections_;
  const LmdSet all = lmds_;
  lmds_.pop_back();
  EXPECT_EQ(judged().missed, 1u) << objections_;
  lmds_ = {all[0], all[1], all[1]};
  EXPECT_EQ(judged().doubled, 1u) << objections_;
  lmds_ = all;
  lmds_.push_back(all[0]);
  lmds_.back().distance += 1e-4;
  lmds_.back().point_moving.z() += 1e-4;
  EXPECT_EQ(judged().untrue, 1u) << objections_;
}

TEST_F(FlatJudgeTest, CutsLikeTheUnionWhateverTheTriangles) {
  // A ring round a square hole: four trapezoids of overlap are one area, its centroid in the hole.
  const double lines[] = {-0.5, -0.25, 0.25, 0.5};
  parts::PrismComplex frame({0.0, 0.25});
  frame.add_grid(lines, lines, [](std::size_t i, std::size_t j) {
    return i == 1 && j == 1 ? parts::NO_LAYER : parts::ALL_LAYERS;
  });
  set(frame.mesh(), make_box({2.0, 2.0, 0.5}, 1), moved(0.625, 0.0, 0.2578125));
  const FlatCounts counts = judged();
  EXPECT_EQ(counts.areas, 1u);
  EXPECT_EQ(counts.right, 1u) << objections_;
}

TEST_F(FlatJudgeTest, AStepHasALevelPlaceWithAWayDown) {
  // The underside is level at .02 over [0, .5], at .01 over [.5, 1]; between them a wall descends.
  parts::PrismComplex step({0.0, 0.01, 0.25});
  const double xs[] = {0.0, 0.5, 1.0}, ys[] = {0.0, 0.5};
  step.add_grid(xs, ys, [](std::size_t i, std::size_t) -> parts::Layers { return i == 0 ? 0b10 : 0b11; });
  set(step.mesh(), make_box({4.0, 4.0, 0.5}, 1), moved(0.0, 0.0, 0.26));
  EXPECT_EQ(truth_->demanded(), 1u);
  Lmd higher;
  higher.point_moving = Vec3(0.25, 0.25, 0.27);
  higher.point_fixed = Vec3(0.25, 0.25, 0.25);
  higher.distance = 0.02;
  for (const bool with_higher : {false, true}) {
    std::erase_if(lmds_, [](const Lmd& lmd) { return lmd.distance > 0.015; });
    if (with_higher) lmds_.push_back(higher);
    const FlatCounts counts = judged();
    EXPECT_EQ(counts.right, 1u);
    EXPECT_EQ(counts.with_way_down, with_higher ? 1u : 0u);
    EXPECT_EQ(counts.faults(), 0u) << objections_;
  }
}

TEST_F(FlatJudgeTest, AsksForNothingThroughAThinWall) {
  // The upper plate is thinner than the cutoff; the floor of its pit is a basin, but faces away.
  const double lines[] = {-0.5, -0.25, 0.25, 0.5};
  parts::PrismComplex plate({0.0, 0.0078125, 0.015625});
  plate.add_grid(lines, lines, [](std::size_t i, std::size_t j) -> parts::Layers {
    return i == 1 && j == 1 ? 0b01 : 0b11;
  });
  set(plate.mesh(), make_box({2.0, 2.0, 0.5}, 1), moved(0.0, 0.0, 0.2578125));
  EXPECT_EQ(truth_->demanded(), 1u);
  EXPECT_EQ(judged().right, 1u) << objections_;
}

TEST_F(FlatJudgeTest, DoesNotJudgeWhatTouches) {
  set(make_box({1.0, 1.0, 0.5}, 1), make_box({2.0, 2.0, 0.5}, 1), moved(0.0, 0.0, 0.5));
  EXPECT_TRUE(truth_->touching());
  EXPECT_EQ(judged().touching_poses, 1u);
}

TEST_F(FlatJudgeTest, LeavesATiltWithinTheToleranceToIt) {
  Pose pose = moved(0.0, 0.0, 0.5078125);
  pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(1e-12, Vec3::UnitX()));
  set(make_box({1.0, 1.0, 0.5}, 1), make_box({2.0, 2.0, 0.5}, 1), pose);
  // In exact arithmetic an edge is lowest; the middle of the face is within the tolerance.
  EXPECT_EQ(truth_->demanded(), 1u);
  EXPECT_EQ(judged().faults(), 0u) << objections_;
}

TEST(FlatJudge, FindsNothingWrongWhereFeetFallOnEndsOfSlits) {
  // Aligned sides: two chains cross at the end of one, and a corner is beside the end of a side.
  struct Found {
    const char* kind;
    parts::Coordinates coordinates;
    std::size_t index, pose;
  };
  for (const Found& found : {Found{"slit plate on ring", parts::Coordinates::EXACT, 0, 1},
                             Found{"slit plate on slit plate", parts::Coordinates::RECUT, 11, 2}}) {
    const parts::PartsScene scene =
        parts::make_parts_scene({found.kind, found.coordinates, 41, found.index, parts::PoseFamily::FLUSH});
    const Pose& pose = scene.poses[found.pose];
    const FlatTruth truth(scene.scene.moving->surface(), scene.scene.fixed[0]->surface(), pose,
                          scene.scene.cutoff);
    std::string faults;
    EXPECT_EQ(truth.judge(truth_of(scene.scene, pose), faults).faults(), 0u) << found.kind << "\n" << faults;
  }
}

/// Share of poses that may be left to tolerance.
constexpr double MOST_TOLERATED = 0.02;

TEST(FlatJudge, FindsNothingWrongInMachineParts) {
  constexpr std::size_t POSES = 2;
  FlatCounts all;
  std::string faults;
  for (const parts::PartsKind& kind : parts::parts_kinds()) {
    for (const parts::Coordinates coordinates : {parts::Coordinates::EXACT, parts::Coordinates::RECUT}) {
      const parts::PartsScene scene =
          parts::make_parts_scene({kind.name, coordinates, 5, 0, parts::PoseFamily::FLUSH});
      for (std::size_t i = 0; i < POSES; ++i) {
        const FlatTruth truth(scene.scene.moving->surface(), scene.scene.fixed[0]->surface(), scene.poses[i],
                              scene.scene.cutoff);
        const std::size_t before = faults.size();
        all += truth.judge(truth_of(scene.scene, scene.poses[i]), faults);
        if (faults.size() > before)
          faults +=
              fmt::format("  {}, coordinates {}, pose {}\n", kind.name, static_cast<int>(coordinates), i);
      }
    }
  }
  const double judged = static_cast<double>(all.poses - all.touching_poses);
  EXPECT_GT(judged, 0.8 * static_cast<double>(all.poses));
  EXPECT_GT(static_cast<double>(all.areas), judged);
  EXPECT_EQ(all.faulty_poses, 0u) << faults;
  EXPECT_LE(static_cast<double>(all.tolerance_poses), MOST_TOLERATED * judged);
}

}  // namespace
}  // namespace lmdbench::exact
