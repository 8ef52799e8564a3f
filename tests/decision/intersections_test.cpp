// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/corner_groups.h>
#include <lmdbench/decision/intersections.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

struct CornerPair {
  std::array<std::int32_t, 3> moving, fixed;
};

bool share_corners(const CornerPair& a, const CornerPair& b) {
  const auto share = [](const auto& x, const auto& y) {
    return std::any_of(x.begin(), x.end(),
                       [&](std::int32_t v) { return std::find(y.begin(), y.end(), v) != y.end(); });
  };
  return share(a.moving, b.moving) && share(a.fixed, b.fixed);
}

TEST(CornerGroups, AreTheConnectedComponents) {
  std::mt19937_64 random(11);
  std::size_t joined = 0, apart = 0;
  for (int round = 0; round < 60; ++round) {
    // Few corners make one group, many make pairs alone; between the two, groups merge late.
    const std::uint64_t corners = 4 + random() % 60;
    std::vector<CornerPair> pairs(1 + random() % 200);
    for (CornerPair& pair : pairs)
      for (int k = 0; k < 3; ++k) {
        pair.moving[k] = static_cast<std::int32_t>(random() % corners);
        pair.fixed[k] = static_cast<std::int32_t>(random() % corners);
      }
    CornerGroups groups(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) groups.add(i, pairs[i].moving, pairs[i].fixed);

    std::vector<std::size_t> expected(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) expected[i] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          if (expected[i] == expected[j] || !share_corners(pairs[i], pairs[j])) continue;
          expected[i] = expected[j] = std::min(expected[i], expected[j]);
          changed = true;
        }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_EQ(groups.group_of(i), expected[i]) << "round " << round << " pair " << i;
      (expected[i] == i ? apart : joined) += 1;
    }
  }
  EXPECT_GT(joined, 500u);
  EXPECT_GT(apart, 200u);
}

TEST(CornerGroups, ForgottenCornersJoinNothing) {
  const std::array<std::int32_t, 1> corner{0};
  CornerGroups groups(3);
  groups.add(0, corner, corner);
  groups.forget_corners();
  groups.add(1, corner, corner);
  groups.add(2, corner, corner);
  EXPECT_EQ(groups.group_of(0), 0u);
  EXPECT_EQ(groups.group_of(1), 1u);
  EXPECT_EQ(groups.group_of(2), 1u);
}

/// Four triangles in a row; 0 and 3 share no corner.
class IntersectionsTest : public ::testing::Test {
 protected:
  IntersectionsTest() {
    const TriangleMesh strip{{{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 1, 0}, {2, 0, 0}},
                             {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}};
    scene_ = testing::make_scene(strip, strip, 1.0);
    scene_.fixed.push_back(scene_.fixed[0]);
  }
  static Intersection faces(std::int32_t moving, std::int32_t fixed, const Vec3& point, double length,
                            std::int32_t body = 0) {
    return {{FeatureKind::FACE, moving}, {FeatureKind::FACE, fixed}, moving, fixed, body, 1, length, point};
  }
  LmdSet contacts(std::vector<Intersection> intersections) const {
    LmdSet lmds;
    append_contacts(scene_, intersections, lmds);
    return lmds;
  }
  Scene scene_;
};

TEST_F(IntersectionsTest, OneContactACurve) {
  const LmdSet one = contacts({faces(0, 0, {0, 0, 0}, 3.0), faces(1, 0, {4, 0, 0}, 1.0)});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].distance, 0.0);
  EXPECT_TRUE(one[0].intersecting);
  EXPECT_TRUE(one[0].point_moving.isApprox(Vec3(1, 0, 0), 1e-12)) << "weighted by length";
  EXPECT_EQ(one[0].point_fixed, one[0].point_moving);
  EXPECT_EQ(one[0].feature_moving.index, 0) << "of the nearest piece";
  EXPECT_EQ(contacts({faces(0, 0, {0, 0, 0}, 1.0), faces(3, 3, {1, 0, 0}, 1.0)}).size(), 2u);
  EXPECT_EQ(contacts({faces(0, 0, {0, 0, 0}, 1.0), faces(0, 3, {1, 0, 0}, 1.0)}).size(), 2u)
      << "a corner on one mesh is not enough";
  EXPECT_EQ(contacts({faces(0, 0, {0, 0, 0}, 1.0), faces(0, 0, {1, 0, 0}, 1.0, 1)}).size(), 2u)
      << "another body is another contact";
}

TEST_F(IntersectionsTest, PointsDoNotWeighBesideSegments) {
  Intersection point = faces(0, 1, {9, 9, 9}, 0.0);
  point.on_moving = {FeatureKind::VERTEX, 0};
  point.dimension = 0;
  const LmdSet both = contacts({point, faces(0, 0, {1, 2, 3}, 0.5)});
  ASSERT_EQ(both.size(), 1u);
  EXPECT_EQ(both[0].point_moving, Vec3(1, 2, 3));
  const LmdSet alone = contacts({point});
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone[0].point_moving, Vec3(9, 9, 9));
  EXPECT_EQ(alone[0].feature_moving.kind, FeatureKind::VERTEX);
}

TEST_F(IntersectionsTest, TheSetAloneDecides) {
  std::mt19937_64 random(5);
  std::vector<Intersection> pieces;
  for (std::int32_t m = 0; m < 4; ++m)
    for (std::int32_t f = 0; f < 4; ++f)
      pieces.push_back(faces(m, f, testing::random_direction(random), testing::uniform(random)));
  const LmdSet expected = contacts(pieces);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(pieces.begin(), pieces.end(), random);
    testing::expect_same_lmds(contacts(pieces), expected);
  }
  // A pair in the list twice counts once.
  std::vector<Intersection> twice = pieces;
  twice.insert(twice.end(), pieces.begin(), pieces.end());
  EXPECT_EQ(contacts(twice)[0].point_moving, expected[0].point_moving);
}

TEST_F(IntersectionsTest, RoundingDoesNotNameASymmetricContact) {
  for (const double rounding : {-1e-15, 0.0, 1e-15}) {
    const LmdSet set = contacts(
        {faces(0, 0, {-1.0 - rounding, 0, 0}, 1.0), faces(1, 0, {1.0 + rounding, 0, 0}, 1.0 + rounding)});
    ASSERT_EQ(set.size(), 1u);
    EXPECT_EQ(set[0].feature_moving.index, 0) << rounding;
  }
  // A difference less than the error of a kernel's crossing makes no piece the nearer one.
  const LmdSet set = contacts({faces(0, 0, {-1e-13, 0, 0}, 1.0), faces(1, 0, {1e-13, 0, 0}, 2.0)});
  ASSERT_EQ(set.size(), 1u);
  EXPECT_EQ(set[0].feature_moving.index, 0);
}

}  // namespace
}  // namespace lmdbench
