// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/agreement.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace lmdbench {
namespace {

Lmd lmd_of(FeatureId moving, FeatureId fixed, std::int32_t fixed_body = 0) {
  Lmd lmd;
  lmd.distance = 1.0;
  lmd.feature_moving = moving;
  lmd.feature_fixed = fixed;
  lmd.fixed_body = fixed_body;
  return lmd;
}

constexpr FeatureId VERTEX_0{FeatureKind::VERTEX, 0};
constexpr FeatureId VERTEX_1{FeatureKind::VERTEX, 1};
constexpr FeatureId EDGE_0{FeatureKind::EDGE, 0};

class AgreementTest : public ::testing::Test {
 protected:
  AgreementTest() {
    auto box = std::make_shared<const Body>("box", build_surface(make_box(Vec3::Ones())));
    scene_ = {box, {box, box}, 1.0};
    const Surface& surface = box->surface();
    const auto& corners = surface.mesh.triangles[0];
    for (std::size_t i = 0; i < 3; ++i) corner_[i] = {FeatureKind::VERTEX, corners[i]};
    edge_ = {FeatureKind::EDGE, surface.adjacency.triangle_edges[0][0]};
    // The corner diagonally opposite on the box shares no triangle with the first one.
    const std::vector<Vec3>& vertices = surface.mesh.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (vertices[v] == -vertices[static_cast<std::size_t>(corners[0])])
        across_ = {FeatureKind::VERTEX, static_cast<std::int32_t>(v)};
  }
  Agreement same(const LmdSet& truth, const LmdSet& reported) const {
    return agreement(truth, reported, Match::SAME_FEATURES, scene_);
  }
  Agreement near(const LmdSet& truth, const LmdSet& reported) const {
    return agreement(truth, reported, Match::NEIGHBOURING_FEATURES, scene_);
  }

  Scene scene_;
  FeatureId corner_[3];
  FeatureId edge_;
  FeatureId across_;
};

TEST_F(AgreementTest, SameFeaturesMeansBothFeaturesAndTheBody) {
  const LmdSet truth{lmd_of(VERTEX_0, VERTEX_0), lmd_of(VERTEX_0, EDGE_0)};
  const LmdSet reported{lmd_of(VERTEX_0, EDGE_0), lmd_of(VERTEX_0, VERTEX_0, 1), lmd_of(EDGE_0, VERTEX_0),
                        lmd_of(VERTEX_0, VERTEX_1)};
  EXPECT_DOUBLE_EQ(same(truth, reported).recall(), 0.5);
  EXPECT_DOUBLE_EQ(same(truth, reported).precision(), 0.25);
  EXPECT_EQ(same(truth, reported).missed(), 1U);
  EXPECT_EQ(same(truth, reported).wrong(), 3U);
  EXPECT_FALSE(same(truth, reported).exact());
  EXPECT_TRUE(same(truth, {truth[1], truth[0]}).exact());
  EXPECT_FALSE(same(truth, {truth[1]}).exact()) << "one is missing";
}

TEST_F(AgreementTest, ADuplicateIsNotTrue) {
  const LmdSet truth{lmd_of(VERTEX_0, VERTEX_0)};
  const LmdSet twice{truth[0], truth[0]};
  EXPECT_DOUBLE_EQ(same(truth, twice).recall(), 1.0);
  EXPECT_DOUBLE_EQ(same(truth, twice).precision(), 0.5);
  EXPECT_FALSE(same(truth, twice).exact());
  EXPECT_EQ(same(twice, truth).found, 1U) << "one to one";
}

TEST_F(AgreementTest, DistinctPairsHoldEachPairOnce) {
  const LmdSet candidates{lmd_of(VERTEX_1, EDGE_0), lmd_of(VERTEX_0, VERTEX_0), lmd_of(VERTEX_1, EDGE_0),
                          lmd_of(VERTEX_1, EDGE_0, 1), lmd_of(VERTEX_0, VERTEX_0)};
  const LmdSet distinct = distinct_pairs(candidates);
  ASSERT_EQ(distinct.size(), 3U);
  for (const Lmd& candidate : candidates) EXPECT_EQ(same({candidate}, distinct).found, 1U);
}

TEST_F(AgreementTest, RatiosOfNothingAreUnset) {
  const LmdSet one{lmd_of(VERTEX_0, VERTEX_0)};
  EXPECT_TRUE(std::isnan(same({}, one).recall()));
  EXPECT_DOUBLE_EQ(same({}, one).precision(), 0.0);
  EXPECT_DOUBLE_EQ(same(one, {}).recall(), 0.0);
  EXPECT_TRUE(std::isnan(same(one, {}).precision()));
  EXPECT_TRUE(std::isnan(near({}, {}).recall()));
}

TEST_F(AgreementTest, NeighboursShareATriangleOnBothMeshes) {
  const LmdSet truth{lmd_of(corner_[0], edge_)};
  const FeatureId face{FeatureKind::FACE, 0};
  EXPECT_EQ(same(truth, {lmd_of(face, corner_[2])}).found, 0U);
  for (const LmdSet& reported : {LmdSet{lmd_of(face, corner_[2])}, LmdSet{lmd_of(edge_, face)}}) {
    EXPECT_EQ(near(truth, reported).found, 1U);
    EXPECT_EQ(near(truth, reported).right, 1U);
  }
  EXPECT_EQ(near({lmd_of(corner_[0], corner_[0])}, {lmd_of(across_, corner_[0])}).found, 0U);
  EXPECT_EQ(near({lmd_of(corner_[0], corner_[0])}, {lmd_of(corner_[0], across_)}).found, 0U);
  EXPECT_EQ(near(truth, {lmd_of(corner_[0], edge_, 1)}).found, 0U) << "another body";
}

TEST_F(AgreementTest, NeighboursMayShareAPartner) {
  const LmdSet truth{lmd_of(corner_[0], corner_[0]), lmd_of(corner_[0], edge_)};
  const LmdSet reported{lmd_of({FeatureKind::FACE, 0}, {FeatureKind::FACE, 0}), lmd_of(across_, across_)};
  EXPECT_DOUBLE_EQ(near(truth, reported).recall(), 1.0);
  EXPECT_DOUBLE_EQ(near(truth, reported).precision(), 0.5);
}

TEST_F(AgreementTest, SumsArePooledAndNotMeansOfRatios) {
  Agreement sum = same({lmd_of(VERTEX_0, VERTEX_0)}, {});
  const LmdSet three{lmd_of(VERTEX_0, VERTEX_1), lmd_of(VERTEX_1, VERTEX_0), lmd_of(VERTEX_1, VERTEX_1)};
  sum += same(three, {three[0], three[1], three[2], lmd_of(EDGE_0, EDGE_0)});
  EXPECT_EQ(sum.true_lmds, 4U);
  EXPECT_DOUBLE_EQ(sum.recall(), 0.75);
  EXPECT_DOUBLE_EQ(sum.precision(), 0.75);
}

}  // namespace
}  // namespace lmdbench
