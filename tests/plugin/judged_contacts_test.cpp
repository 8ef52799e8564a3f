// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/plugin/judged_contacts.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <cmath>
#include <limits>

namespace lmdbench::testing {
namespace {

/// Two unit cubes; A is 0.25 above B and moved by a third: a corner of A is over a face of B.
class JudgedContacts : public ::testing::Test {
 protected:
  JudgedContacts()
      : scene_(make_scene(make_box(Vec3(1, 1, 1)), make_box(Vec3(1, 1, 1)), 0.5)),
        X_(moved(1.0 / 3, 0.25, 1.25)) {}

  /// A contact of a point of a triangle of A with the point below it on a triangle of B.
  lmdbench_contact corner_over_face() const {
    const TriangleMesh &a = scene_.moving->surface().mesh, &b = scene_.fixed[0]->surface().mesh;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(a.triangles.size()); ++t)
      for (std::int32_t corner = 0; corner < 3; ++corner) {
        const Vec3 p = RigidTransform(X_).point(a.triangle(t)[static_cast<std::size_t>(corner)]);
        if (std::abs(p.z() - 0.75) > 1e-12 || p.x() > 0.5 || p.y() > 0.5) continue;
        for (std::int32_t s = 0; s < static_cast<std::int32_t>(b.triangles.size()); ++s) {
          const Triangle under = b.triangle(s);
          const Vec3 q(p.x(), p.y(), 0.5);
          if (std::abs(under[0].z() - 0.5) + std::abs(under[1].z() - 0.5) + std::abs(under[2].z() - 0.5) > 0)
            continue;
          const auto side = [&](int i) {
            const Vec3 &u = under[static_cast<std::size_t>(i)],
                       &v = under[static_cast<std::size_t>((i + 1) % 3)];
            return (v - u).cross(q - u).z();
          };
          if (side(0) <= 0 || side(1) <= 0 || side(2) <= 0) continue;
          return {{p.x(), p.y(), p.z()},      {q.x(), q.y(), q.z()}, t, s,
                  LMDBENCH_CORNER_0 + corner, LMDBENCH_FACE};
        }
      }
    return {};
  }
  LmdSet judge(const std::vector<lmdbench_contact>& contacts) {
    LmdSet lmds;
    marks_ = {};
    ContactJudge(scene_.moving, scene_.fixed[0].body).judge(contacts, RigidTransform(X_), lmds, marks_);
    EXPECT_TRUE(is_well_formed(lmds, scene_));
    return lmds;
  }
  std::uint64_t mark(PluginMark which) const { return marks_.values[static_cast<std::size_t>(which)]; }

  Scene scene_;
  Pose X_;
  WorkCounters marks_;
};

TEST_F(JudgedContacts, BecomeLmdsWithTheProgramsOwnDistances) {
  const LmdSet lmds = judge({corner_over_face()});
  ASSERT_EQ(lmds.size(), 1U);
  EXPECT_DOUBLE_EQ(lmds[0].distance, 0.25);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::FACE);
  EXPECT_EQ(lmds[0].direction, Vec3(0, 0, -1));
  EXPECT_EQ(marks_, WorkCounters{});
}

TEST_F(JudgedContacts, PartsThatAreNotNamedOrWrongAreLookedUp) {
  lmdbench_contact contact = corner_over_face();
  contact.part_a = contact.part_b = LMDBENCH_PART_UNKNOWN;
  LmdSet lmds = judge({contact});
  ASSERT_EQ(lmds.size(), 1U);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::FACE);
  EXPECT_EQ(mark(PluginMark::OTHER_PART), 0U);
  contact.part_b = LMDBENCH_EDGE_1;
  lmds = judge({contact});
  ASSERT_EQ(lmds.size(), 1U);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::FACE);
  EXPECT_EQ(mark(PluginMark::OTHER_PART), 1U);
  contact.part_b = 12345;
  EXPECT_EQ(judge({contact}).size(), 1U);
  EXPECT_EQ(mark(PluginMark::OTHER_PART), 1U);
}

TEST_F(JudgedContacts, WhatIsNotOnTheMeshIsLeftOut) {
  const lmdbench_contact good = corner_over_face();
  lmdbench_contact above = good, beside = good, no_triangle = good, none = good, nan = good, infinite = good;
  above.point_b[2] += 1e-5;
  beside.point_a[0] += 1e-5;
  no_triangle.triangle_a = 12;
  none.triangle_b = -1;
  nan.point_a[1] = NAN;
  infinite.point_b[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judge({above, good, beside, no_triangle, none, nan, infinite}).size(), 1U);
  EXPECT_EQ(mark(PluginMark::OFF_MESH), 4U);
  EXPECT_EQ(mark(PluginMark::NOT_FINITE), 2U);
  lmdbench_contact rounded = good;
  for (double& x : rounded.point_a) x = static_cast<float>(x);
  EXPECT_EQ(judge({rounded}).size(), 1U) << "single precision will do";
}

TEST_F(JudgedContacts, PairsCountOnceAndTheOrderIsMade) {
  const lmdbench_contact good = corner_over_face();
  lmdbench_contact farther = good;
  farther.point_b[0] -= 0.01;  // still on the same face
  EXPECT_EQ(judge({good, farther, good}).size(), 1U);
  EXPECT_EQ(mark(PluginMark::DUPLICATES), 2U);
  EXPECT_EQ(mark(PluginMark::UNSORTED), 1U);
  EXPECT_DOUBLE_EQ(judge({farther, good}).front().distance, 0.25) << "the nearest of them";
  EXPECT_EQ(judge({good, farther}).size(), 1U);
  EXPECT_EQ(mark(PluginMark::UNSORTED), 0U);
}

}  // namespace
}  // namespace lmdbench::testing
