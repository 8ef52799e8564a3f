// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/matching.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

Lmd pair_of(FeatureId moving, FeatureId fixed, std::int32_t body = 0) {
  Lmd lmd;
  lmd.feature_moving = moving;
  lmd.feature_fixed = fixed;
  lmd.fixed_body = body;
  return lmd;
}

constexpr FeatureId VERTEX_0{FeatureKind::VERTEX, 0};
constexpr FeatureId VERTEX_1{FeatureKind::VERTEX, 1};
constexpr FeatureId EDGE_0{FeatureKind::EDGE, 0};

TEST(StrictAgreement, NeedsTheSameFeaturesOnTheSameBody) {
  const LmdSet truth{pair_of(VERTEX_0, VERTEX_0), pair_of(VERTEX_0, EDGE_0)};
  const LmdSet set{pair_of(VERTEX_0, EDGE_0), pair_of(VERTEX_0, VERTEX_0, 1), pair_of(EDGE_0, VERTEX_0),
                   pair_of(VERTEX_0, VERTEX_1)};
  const SetAgreement agreement = strict_agreement(set, truth);
  EXPECT_DOUBLE_EQ(agreement.recall, 0.5);
  EXPECT_DOUBLE_EQ(agreement.precision, 0.25);
}

TEST(StrictAgreement, ADuplicateCostsPrecision) {
  const LmdSet truth{pair_of(VERTEX_0, VERTEX_0)};
  const LmdSet set{pair_of(VERTEX_0, VERTEX_0), pair_of(VERTEX_0, VERTEX_0)};
  EXPECT_DOUBLE_EQ(strict_agreement(set, truth).recall, 1.0);
  EXPECT_DOUBLE_EQ(strict_agreement(set, truth).precision, 0.5);
}

TEST(StrictAgreement, SharesOfNothingAreUnset) {
  const LmdSet one{pair_of(VERTEX_0, VERTEX_0)};
  EXPECT_TRUE(std::isnan(strict_agreement(one, {}).recall));
  EXPECT_DOUBLE_EQ(strict_agreement(one, {}).precision, 0.0);
  EXPECT_DOUBLE_EQ(strict_agreement({}, one).recall, 0.0);
  EXPECT_TRUE(std::isnan(strict_agreement({}, one).precision));
}

TEST(AdjacentAgreement, AcceptsFeaturesThatShareATriangleOnBothSides) {
  const Surface sphere = build_surface(make_sphere(1.0, 2));
  const auto& corners = sphere.mesh.triangles[0];
  const FeatureId face{FeatureKind::FACE, 0};
  const FeatureId corner{FeatureKind::VERTEX, corners[0]};
  const FeatureId edge{FeatureKind::EDGE, sphere.adjacency.triangle_edges[0][0]};
  // A vertex that shares no triangle with corners[0]: the farthest one.
  FeatureId far{FeatureKind::VERTEX, 0};
  double largest = 0.0;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(sphere.mesh.vertices.size()); ++i) {
    const double distance = (sphere.mesh.vertices[static_cast<std::size_t>(i)] -
                             sphere.mesh.vertices[static_cast<std::size_t>(corners[0])])
                                .norm();
    if (distance > largest) {
      largest = distance;
      far.index = i;
    }
  }
  const std::vector<const Surface*> fixed{&sphere, &sphere};
  const LmdSet truth{pair_of(corner, edge)};
  const auto recall = [&](const LmdSet& set) { return adjacent_agreement(set, truth, sphere, fixed).recall; };
  EXPECT_EQ(recall({pair_of(face, face)}), 1.0);
  EXPECT_EQ(recall({pair_of(edge, corner)}), 1.0);
  EXPECT_EQ(recall({pair_of(far, edge)}), 0.0);
  EXPECT_EQ(recall({pair_of(corner, far)}), 0.0);
  EXPECT_EQ(recall({pair_of(corner, edge, 1)}), 0.0) << "another body";
  const SetAgreement both =
      adjacent_agreement({pair_of(face, face), pair_of(far, far)}, truth, sphere, fixed);
  EXPECT_DOUBLE_EQ(both.recall, 1.0);
  EXPECT_DOUBLE_EQ(both.precision, 0.5);
}

}  // namespace
}  // namespace lmdbench
