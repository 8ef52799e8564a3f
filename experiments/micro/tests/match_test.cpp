// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>

#include <gtest/gtest.h>
#include <micro/match.h>

#include <cmath>

namespace lmdbench::micro {
namespace {

Lmd lmd_of(FeatureId moving, FeatureId fixed, std::int32_t fixed_body = 0) {
  Lmd lmd;
  lmd.distance = 1.0;
  lmd.feature_moving = moving;
  lmd.feature_fixed = fixed;
  lmd.fixed_body = fixed_body;
  return lmd;
}

class MatchTest : public testing::Test {
 protected:
  MatchTest() {
    auto box = std::make_shared<const Body>("box", build_surface(make_box(Vec3::Ones())));
    scene_ = {box, {box, box}, 1.0};
    const auto& corners = box->surface().mesh.triangles[0];
    for (std::size_t i = 0; i < 3; ++i) corner_[i] = {FeatureKind::VERTEX, corners[i]};
    // The corner diagonally across the box shares no triangle with the first one.
    const std::vector<Vec3>& vertices = box->surface().mesh.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (vertices[v] == -vertices[static_cast<std::size_t>(corners[0])])
        across_ = {FeatureKind::VERTEX, static_cast<std::int32_t>(v)};
  }
  MatchCount count(const LmdSet& truth, const LmdSet& reported, Match match) const {
    return count_matches(truth, reported, match, scene_);
  }

  Scene scene_;
  FeatureId corner_[3];
  FeatureId across_;
};

TEST_F(MatchTest, CountsARepeatedPairOnce) {
  const LmdSet truth = {lmd_of(corner_[0], corner_[1])};
  const LmdSet reported = {truth[0], lmd_of(across_, corner_[1]), truth[0], truth[0]};
  const MatchCount result = count(truth, reported, Match::FEATURE_PAIR);
  EXPECT_EQ(result.truths, 1U);
  EXPECT_EQ(result.found, 1U);
  EXPECT_EQ(result.reported, 2U);
  EXPECT_EQ(result.right, 1U);
  EXPECT_DOUBLE_EQ(result.recall(), 1.0);
  EXPECT_DOUBLE_EQ(result.precision(), 0.5);
}

TEST_F(MatchTest, AdjacentNeedsACommonTriangleOnBothSides) {
  const LmdSet truth = {lmd_of(corner_[0], corner_[1])};
  const LmdSet neighbour = {lmd_of({FeatureKind::FACE, 0}, corner_[2])};
  EXPECT_EQ(count(truth, neighbour, Match::FEATURE_PAIR).found, 0U);
  EXPECT_EQ(count(truth, neighbour, Match::ADJACENT).found, 1U);
  EXPECT_EQ(count(truth, neighbour, Match::ADJACENT).right, 1U);
  const LmdSet far_on_one_side = {lmd_of(across_, corner_[1])};
  EXPECT_EQ(count(truth, far_on_one_side, Match::ADJACENT).found, 0U);
}

TEST_F(MatchTest, FixedBodiesAreDifferentThings) {
  const LmdSet truth = {lmd_of(corner_[0], corner_[1], 0)};
  const LmdSet other_body = {lmd_of(corner_[0], corner_[1], 1)};
  EXPECT_EQ(count(truth, other_body, Match::FEATURE_PAIR).found, 0U);
  EXPECT_EQ(count(truth, other_body, Match::ADJACENT).found, 0U);
}

TEST_F(MatchTest, RatiosOfNothingAreUnset) {
  EXPECT_TRUE(std::isnan(count({}, {}, Match::FEATURE_PAIR).recall()));
  EXPECT_TRUE(std::isnan(count({lmd_of(corner_[0], corner_[1])}, {}, Match::FEATURE_PAIR).precision()));
}

}  // namespace
}  // namespace lmdbench::micro
