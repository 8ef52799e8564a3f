// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/flat_triangles.h>
#include <lmdbench/mesh/flaws.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <study/completeness/judge.h>

namespace lmdbench::completeness {
namespace {

using ::testing::HasSubstr;

class JudgeTest : public ::testing::Test {
 protected:
  JudgeTest() {
    const auto body = std::make_shared<const Body>("box", build_surface(make_box(Vec3::Ones())));
    scene_.moving = body;
    scene_.fixed = {body};
    for (const int vertex : {0, 1, 2}) {
      Lmd lmd;
      lmd.distance = 0.1 * (vertex + 1);
      lmd.point_moving = Vec3::Zero();
      lmd.point_fixed = Vec3(lmd.distance, 0.0, 0.0);
      lmd.feature_moving = {FeatureKind::VERTEX, vertex};
      lmd.direction = Vec3::UnitX();
      lmd.feature_fixed = {FeatureKind::VERTEX, 0};
      lmd.triangle_moving = body->surface().incident_triangles(lmd.feature_moving)[0];
      lmd.triangle_fixed = body->surface().incident_triangles(lmd.feature_fixed)[0];
      truth_.push_back(lmd);
    }
  }
  Judgement judge_now(const LmdSet& reported) { return judge(truth_, reported, scene_, 1.0, objection_); }

  Scene scene_;
  LmdSet truth_;
  std::string objection_;
};

TEST_F(JudgeTest, HasNothingAgainstTheTruth) {
  const Judgement judgement = judge_now(truth_);
  EXPECT_EQ(judgement.wrong_poses, 0u) << objection_;
  EXPECT_EQ(judgement.same.recall(), 1.0);
  EXPECT_EQ(judgement.same.precision(), 1.0);
  EXPECT_EQ(judgement.worst_point_difference, 0.0);
}

TEST_F(JudgeTest, NamesAMiss) {
  LmdSet reported = truth_;
  reported.erase(reported.begin() + 1);
  const Judgement judgement = judge_now(reported);
  EXPECT_EQ(judgement.wrong_poses, 1u);
  EXPECT_EQ(judgement.same.missed(), 1u);
  EXPECT_THAT(objection_, HasSubstr("missed vertex 1"));
}

TEST_F(JudgeTest, NamesWhatIsNoLmd) {
  LmdSet reported = truth_;
  reported[0].feature_moving.index = 7;
  EXPECT_EQ(judge_now(reported).same.right, 2u);
  EXPECT_THAT(objection_, HasSubstr("reported vertex 7"));
}

TEST_F(JudgeTest, CountsDuplicates) {
  LmdSet reported = truth_;
  reported.push_back(truth_[2]);
  const Judgement judgement = judge_now(reported);
  EXPECT_EQ(judgement.duplicates, 1u);
  EXPECT_EQ(judgement.wrong_poses, 1u);
}

TEST_F(JudgeTest, PartsOfOnePairAreLmdsOfTheirOwn) {
  Lmd part = truth_[2];
  part.point_fixed.y() = part.point_moving.y() = 0.7;
  truth_.push_back(part);
  const Judgement judgement = judge_now(truth_);
  EXPECT_EQ(judgement.duplicates, 0u);
  EXPECT_EQ(judgement.wrong_poses, 0u) << objection_;
  LmdSet reported = truth_;
  reported[3] = truth_[2];
  EXPECT_EQ(judge_now(reported).wrong_poses, 1u) << "the other part, twice";
}

TEST_F(JudgeTest, TwoOfOnePairAtOnePlaceAreToldByTheirDistances) {
  Lmd other = truth_[2];
  other.distance += 1e-15;
  other.direction = -other.direction;
  truth_.push_back(other);
  EXPECT_EQ(judge_now(truth_).wrong_poses, 0u) << objection_;
}

TEST_F(JudgeTest, TellsWhatIntersectsFromAnLmdOfTheSameFeatures) {
  Lmd touching = truth_[1];
  touching.intersecting = true;
  touching.distance = 0.0;
  touching.point_fixed = touching.point_moving;
  truth_.insert(truth_.begin(), touching);
  EXPECT_EQ(judge_now(truth_).wrong_poses, 0u) << objection_;
  LmdSet reported = truth_;
  reported[0].intersecting = false;
  EXPECT_EQ(judge_now(reported).wrong_poses, 1u);
  EXPECT_EQ(judge_now(reported).duplicates, 1u);
}

TEST_F(JudgeTest, MeasuresDistancesAndPoints) {
  LmdSet reported = truth_;
  reported[0].point_fixed.y() += 0.5 * POSITION_TOLERANCE;
  EXPECT_EQ(judge_now(reported).wrong_poses, 0u);
  reported[0].point_fixed.y() += POSITION_TOLERANCE;
  EXPECT_EQ(judge_now(reported).wrong_poses, 1u);
  EXPECT_THAT(objection_, HasSubstr("off by"));
  reported = truth_;
  reported[1].distance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge_now(reported).wrong_poses, 1u) << "NaN";
}

TEST_F(JudgeTest, ComparesDirections) {
  for (const Vec3& wrong : {Vec3(-Vec3::UnitX()), Vec3(Vec3::UnitY()),
                            Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()))}) {
    LmdSet reported = truth_;
    reported[1].direction = wrong;
    EXPECT_EQ(judge_now(reported).wrong_poses, 1u);
    EXPECT_THAT(objection_, HasSubstr("another direction"));
  }
  truth_[0].distance = 0.0;
  truth_[0].point_fixed = truth_[0].point_moving;
  truth_[0].direction.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(judge_now(truth_).wrong_poses, 0u) << objection_;
}

TEST_F(JudgeTest, WantsTrianglesThatHoldTheFeaturesAndTheOrder) {
  LmdSet reported = truth_;
  reported[2].triangle_fixed = -1;
  EXPECT_EQ(judge_now(reported).wrong_poses, 1u);
  EXPECT_THAT(objection_, HasSubstr("not well formed"));
  reported = truth_;
  std::swap(reported[0], reported[1]);
  EXPECT_EQ(judge_now(reported).wrong_poses, 1u);
}

TEST_F(JudgeTest, WantsTheNearestPair) {
  const auto wrong = [&](double nearest) {
    return judge(truth_, truth_, scene_, 1.0, objection_, NearestLmd{nearest, 1e-9}).wrong_poses;
  };
  EXPECT_EQ(wrong(0.1 + 1e-10), 0u) << objection_;
  EXPECT_EQ(wrong(0.1 + 1e-8), 1u);
  EXPECT_EQ(wrong(0.1 - 1e-8), 1u);
  truth_.clear();
  EXPECT_EQ(wrong(0.1), 1u);
}

TEST_F(JudgeTest, AsksForTheNearestPairOfSolidsThatAreApart) {
  const NearestLmds nearest(scene_);
  const auto at = [&](double x, double cutoff) { return nearest.at({Vec3(x, 0, 0)}, cutoff); };
  ASSERT_TRUE(at(1.25, 0.5));
  EXPECT_DOUBLE_EQ(at(1.25, 0.5)->distance, 0.25);
  EXPECT_FALSE(at(1.25, 0.2)) << "beyond the cutoff";
  EXPECT_FALSE(at(0.5, 0.5)) << "they intersect";
  const auto body_of = [](const TriangleMesh& mesh) {
    return std::make_shared<const Body>("box", build_surface(mesh));
  };
  const Scene inside{body_of(make_box(Vec3::Constant(0.5))), scene_.fixed, 1.0};
  EXPECT_FALSE(NearestLmds(inside).at({}, 1.0));
  EXPECT_TRUE(NearestLmds(inside).at({Vec3(1.0, 0, 0)}, 1.0));
  TriangleMesh open = make_box(Vec3::Constant(0.5));
  open.triangles.pop_back();
  const Scene sheet{body_of(open), scene_.fixed, 1.0};
  EXPECT_FALSE(NearestLmds(sheet).at({Vec3(1.0, 0, 0)}, 1.0));
  for (const double thickness : {0.0, 1e-9}) {  // a plate that rounding flattened has no solid
    const Scene plate{body_of(make_box(Vec3(0.5, 0.5, thickness))), scene_.fixed, 1.0};
    EXPECT_EQ(NearestLmds(plate, true).at({Vec3(1.0, 0.1, 0.2)}, 1.0).has_value(), thickness > 0.0);
  }
}

TEST_F(JudgeTest, AsksForNoNearestPairOfTJunctionsThatLoadingFlips) {
  TriangleMesh box = make_box(Vec3::Constant(0.5));
  const auto [a, b, c] = box.triangles.front();
  const auto m = static_cast<std::int32_t>(box.vertices.size());
  box.vertices.push_back(
      0.5 * (box.vertices[static_cast<std::size_t>(a)] + box.vertices[static_cast<std::size_t>(b)]));
  box.triangles.front() = {a, m, c};
  box.triangles.push_back({m, b, c});
  box.triangles.push_back({a, b, m});
  for (const bool is_loaded : {false, true}) {
    if (is_loaded) flip_flat_triangles(box);
    const Scene scene{std::make_shared<const Body>("box", build_surface(box)), scene_.fixed, 1.0};
    EXPECT_EQ(NearestLmds(scene, true).at({Vec3(1.0, 0.1, 0.2)}, 1.0).has_value(), is_loaded);
  }
}

/// A cube, and a small one turned inside out that touches it in a corner: closed, without folds.
TEST_F(JudgeTest, AsksForNoNearestPairOfWhatIsTurnedInsideOut) {
  const TriangleMesh inverted = with_flips(make_box(Vec3::Constant(0.25)), 1);
  const TriangleMesh both = merged(make_box(Vec3::Ones()), translated(inverted, Vec3::Constant(0.625)));
  const Scene scene{std::make_shared<const Body>("both", build_surface(both)), scene_.fixed, 1.0};
  const NearestLmds nearest(scene);
  EXPECT_TRUE(nearest.at({Vec3(1.125, 0, 0)}, 0.5)) << "the cube's side";
  EXPECT_FALSE(nearest.at({Vec3(-1.5, -0.75, -0.75)}, 0.5)) << "the inverted one's";
}

}  // namespace
}  // namespace lmdbench::completeness
