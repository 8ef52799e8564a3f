// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/decision/join_contacts.h>
#include <lmdbench/decision/represent_contacts.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/mesh/flaws.h>

#include <gtest/gtest.h>
#include <support/lmd_text.h>
#include <support/rounded.h>
#include <support/shape_scene.h>
#include <support/sheets.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using testing::edge_down;
using testing::moved;
using testing::ShapeScene;
using testing::sheet_of;
using testing::text;
using testing::turned_by;
using testing::uniform;
using enum FeatureKind;

/// Distance of a point from the mesh feature with this id.
double off_feature(const Surface& surface, const FeatureId& feature, const Vec3& p_S) {
  if (feature.kind == VERTEX)
    return (surface.mesh.vertices[static_cast<std::size_t>(feature.index)] - p_S).norm();
  if (feature.kind == EDGE)
    return (point_segment_distance(p_S, surface.edge(feature.index)).point - p_S).norm();
  return (point_triangle_distance(p_S, surface.mesh.triangle(feature.index)).point - p_S).norm();
}

/// The only LMD nearer than .5, after a check that its points are on its features.
Lmd only(ShapeScene& scene, const Pose& pose) {
  LmdSet lmds = scene.lmds(pose);
  std::erase_if(lmds, [](const Lmd& lmd) { return lmd.distance > 0.5; });
  EXPECT_EQ(lmds.size(), 1u) << text(lmds);
  if (lmds.empty()) return {};
  const Lmd& lmd = lmds.front();
  const Vec3 p_M = pose.rotation.conjugate() * (lmd.point_moving - pose.translation);
  const double known = scene.at(pose).tolerance.known;
  EXPECT_LE(off_feature(scene.moving(), lmd.feature_moving, p_M), known) << text(lmds);
  EXPECT_LE(off_feature(scene.fixed(), lmd.feature_fixed, lmd.point_fixed), known) << text(lmds);
  EXPECT_NEAR((lmd.point_fixed - lmd.point_moving).norm(), lmd.distance, 1e-13);
  return lmd;
}

TriangleMesh square_table(double side = 4.0, int cells = 1) {
  return translated(make_box({side, side, 1.0}, cells), Vec3(0.0, 0.0, -0.5));
}
/// Unit box over the plane z = 0.
TriangleMesh box(int cells = 1) {
  return translated(make_box({1.0, 1.0, 1.0}, cells), Vec3(0.0, 0.0, 0.5));
}

TEST(JoinContacts, ABoxOnATableHasOneLmdHoweverBothAreCut) {
  for (const int cells : {1, 2, 5})
    for (const Pose& whole : {Pose{}, testing::pose_of_seed(1)}) {
      ShapeScene scene(box(cells), testing::placed(square_table(4.0, 7 - cells), whole));
      for (const double yaw : {0.0, 0.3, 0.25 * std::numbers::pi})
        for (const double gap : {1e-7, 1e-3, 0.2}) {
          const Lmd lmd = only(scene, whole * turned_by(yaw, Vec3::UnitZ(), Vec3(0.3, -0.2, gap)));
          EXPECT_EQ(lmd.feature_moving.kind, FACE);
          EXPECT_EQ(lmd.feature_fixed.kind, FACE);
          EXPECT_NEAR(lmd.distance, gap, 1e-14);
          const Vec3 q = whole.rotation.conjugate() * (lmd.point_fixed - whole.translation);
          EXPECT_NEAR((q - Vec3(0.3, -0.2, 0.0)).norm(), 0.0, 1e-13);
        }
    }
}

TEST(JoinContacts, TheMiddleOfPiecesOfWhichOneCrossesIsAsFarAsItsPoints) {
  // By the tolerance, as thin plates in floats do.
  ShapeScene scene(merged(box(), translated(box(), Vec3(1.5, 0.0, 0.0))), square_table(8.0));
  const ShapePair pair = scene.at(moved(0.2, 0.1, 1e-3));
  ContactSet set = scene.contacts(pair);
  std::pmr::monotonic_buffer_resource memory;
  ContactPlaces places(pair, set, memory);
  ContactPointers pieces(&memory);
  Contact* last = nullptr;
  for (Contact& contact : set.contacts)
    if (contact.dimension == 2) pieces.push_back(last = &contact);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(represent_contacts(pair, places, pieces).contact().distance, 1e-3, 1e-15);
  Contact& crosses = *last;
  std::swap(crosses.point_moving, crosses.point_fixed);
  crosses.measure *= 3.0;
  const Representative middle = represent_contacts(pair, places, pieces);
  EXPECT_NEAR(middle.contact().distance, 5e-4, 1e-15);
  EXPECT_NEAR((middle.contact().point_fixed - middle.contact().point_moving).norm(), 5e-4, 1e-15);
}

void expect_any_order_gives_the_same(ShapeScene& scene, const Pose& pose) {
  std::mt19937_64 random(2);
  LmdSet expected = scene.lmds(pose);
  std::ranges::sort(expected, lmd_less);
  ASSERT_FALSE(expected.empty());
  for (int i = 0; i < 10; ++i) {
    const ShapePair pair = scene.at(pose);
    ContactSet set = scene.contacts(pair);
    // Contacts at a point may occur twice.
    for (std::size_t k = set.contacts.size(); k-- > 0;)
      if (set.contacts[k].dimension == 0 && random() % 2 == 0)
        set.contacts.push_back(Contact(set.contacts[k]));
    std::shuffle(set.contacts.begin(), set.contacts.end(), random);
    LmdSet lmds = testing::joined(pair, set);
    std::ranges::sort(lmds, lmd_less);
    ASSERT_EQ(lmds.size(), expected.size()) << text(lmds) << "expected\n" << text(expected);
    for (std::size_t k = 0; k < lmds.size(); ++k) {
      EXPECT_TRUE(same_feature_pair(lmds[k], expected[k])) << text(lmds) << "expected\n" << text(expected);
      EXPECT_NEAR((lmds[k].point_moving - expected[k].point_moving).norm(), 0.0, 1e-14);
      EXPECT_NEAR((lmds[k].direction - expected[k].direction).norm(), 0.0, 1e-14);
    }
  }
}

TEST(JoinContacts, TheOrderOfContactsDoesNotMatter) {
  ShapeScene scene(merged(box(2), translated(box(), Vec3(1.5, 0.0, 0.0))), square_table());
  for (const Pose& pose : {moved(0.2, 0.1, 0.05), turned_by(1e-9, Vec3::UnitX(), Vec3(0.0, 0.3, 0.1)),
                           turned_by(0.2, Vec3(1.0, 0.3, 0.1), Vec3(0.0, 0.0, 0.4))})
    expect_any_order_gives_the_same(scene, pose);
}

/// Two boxes of which an upright edge of each touches one of the other along a tenth of it, where
/// the moving one is not turned by more than a quarter turn about it.
ShapeScene edge_along_edge() {
  const auto box_at = [](const Vec3& middle) { return translated(make_box({1.0, 1.0, 1.0}), middle); };
  return {box_at(Vec3(-0.5, 0.5, 0.9)), box_at(Vec3(0.5, -0.5, 0.0))};
}

/// An edge along an edge touches it in any of many directions: what it meets in two known ones
/// stays two, whatever is asked first.
TEST(JoinContacts, EdgesThatTouchAlongEachOtherLeaveTheFacesBesideThemApart) {
  ShapeScene scene = edge_along_edge();
  for (const double angle : {0.05, 0.18, 0.4})
    for (const double gap : {0.0, 2e-16, 1.8e-15}) {
      SCOPED_TRACE(::testing::Message() << "angle " << angle << ", gap " << gap);
      const Pose pose = turned_by(angle, Vec3::UnitZ(), Vec3(-gap, 0.0, 0.0));
      const LmdSet lmds = scene.lmds(pose);
      // The edge of one on the face of the other, and the other way round.
      for (const Vec3& direction : {Vec3(1.0, 0.0, 0.0), Vec3(std::sin(angle), -std::cos(angle), 0.0)})
        EXPECT_EQ(std::ranges::count_if(
                      lmds, [&](const Lmd& lmd) { return (lmd.direction - direction).norm() < 1e-9; }),
                  1)
            << direction.transpose() << ":\n"
            << text(lmds);
      EXPECT_EQ(lmds.size(), 2u) << text(lmds);
      expect_any_order_gives_the_same(scene, pose);
    }
}

TEST(JoinContacts, EdgeOverEdgeIsOneLmdAndOnlyItsNameSwitches) {
  // The box's side is above the table's side, moved in and out by an offset.
  ShapeScene scene(box(), square_table());
  const double gap = 0.01;
  for (const double sign : {-1.0, 1.0})
    for (const double offset : {0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5}) {
      SCOPED_TRACE(sign * offset);
      const Lmd lmd = only(scene, moved(2.5 + sign * offset, 0.5, gap));
      EXPECT_NEAR(lmd.distance, std::hypot(gap, std::max(0.0, sign * offset)), 1e-13);
      EXPECT_NEAR(lmd.point_fixed.x(), 2.0, offset + 1e-13) << "it moves by no more than the box";
      EXPECT_NEAR(lmd.point_fixed.y(), 0.5, 1e-13);
      EXPECT_EQ(lmd.feature_moving.kind, sign < 0.0 && offset > 5e-9 ? FACE : EDGE);
      EXPECT_EQ(lmd.feature_fixed.kind, sign < 0.0 && offset > 5e-9 ? FACE : EDGE);
    }
  // A yaw less than the tolerance: the same segment, not the sliver of the faces.
  const Lmd lmd = only(scene, moved(2.0, 0.5, gap) * turned_by(1e-10, Vec3::UnitZ(), Vec3(0.5, 0.0, 0.0)));
  EXPECT_EQ(lmd.feature_moving.kind, EDGE);
  EXPECT_NEAR((lmd.point_fixed - Vec3(2.0, 0.5, 0.0)).norm(), 0.0, 1e-9);
}

TEST(JoinContacts, OfSegmentsOfOneLengthRoundingDoesNotChoose) {
  // The box's side is above the table's side, or within 1e-11 of it. The box's edge over the table,
  // the table's edge below the box, and both edges share equally long segments, but for rounding.
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Pose whole = testing::pose_of_seed(seed), own = testing::pose_of_seed(seed + 100);
    ShapeScene scene(testing::placed(make_box({1.0, 0.7, 1.0}, 1 + static_cast<int>(seed % 3)), own),
                     testing::placed(square_table(0.3 + 0.1 * static_cast<double>(seed)), whole));
    const double end = 0.5 * (0.3 + 0.1 * static_cast<double>(seed));
    for (const double offset : {-1e-11, -1e-12, 0.0, 1e-12}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", offset " << offset);
      const Lmd lmd = only(scene, whole * moved(end + 0.5 + offset, 0.05, 0.51) * own.inverse());
      EXPECT_EQ(lmd.feature_moving.kind, EDGE);
      EXPECT_EQ(lmd.feature_fixed.kind, EDGE);
    }
  }
}

/// From rounding on edges past each other are one LMD, in the direction of their gap.
TEST(JoinContacts, EdgesPastEachOtherAreOneLmdInTheDirectionOfTheirGap) {
  ShapeScene scene = edge_along_edge();
  const double yaw = 0.18;
  for (const double share : {0.1, 0.5, 0.9})
    for (const double gap : {2.5e-13, 8e-13, 3e-12, 1e-9, 1e-5}) {
      SCOPED_TRACE(::testing::Message() << "share " << share << ", gap " << gap);
      const double angle = share * (yaw - 0.5 * std::numbers::pi);
      const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
      const Lmd lmd = only(scene, turned_by(yaw, Vec3::UnitZ(), -gap * direction));
      EXPECT_NEAR((lmd.direction - direction).norm(), 0.0, 1e-15 / gap);
    }
}

/// The same with some of the contacts: what is unknown gives its points, and takes a direction.
TEST(JoinContacts, WhatTouchesInNoKnownDirectionHasThoseOfWhatItMeets) {
  ShapeScene scene = edge_along_edge();
  const double angle = 0.18;
  const Pose pose = turned_by(angle, Vec3::UnitZ(), Vec3(-1.8e-15, 0.0, 0.0));
  const ShapePair pair = scene.at(pose);
  const auto knows = [&](const Contact& c) { return c.knows_direction(pair.tolerance.rounding); };
  const Vec3 of_moving(std::sin(angle), -std::cos(angle), 0.0);
  const auto joined_without = [&](auto&& leaves_out) {
    ContactSet set = scene.contacts(pair);
    EXPECT_GT(std::erase_if(set.contacts, leaves_out), 0u);
    return testing::joined(pair, set);
  };
  const LmdSet two = joined_without([&](const Contact& c) { return c.dimension == 0 && knows(c); });
  EXPECT_EQ(two.size(), 2u) << text(two);
  const LmdSet one =
      joined_without([&](const Contact& c) { return knows(c) && (c.direction - of_moving).norm() > 1e-9; });
  ASSERT_EQ(one.size(), 1u) << text(one);
  EXPECT_NEAR((one[0].direction - of_moving).norm(), 0.0, 1e-9) << text(one);
}

TEST(JoinContacts, ContactsThatMeetInTwoKnownDirectionsAreTwoLmds) {
  ShapeScene scene(box(), square_table());
  const ShapePair pair = scene.at(moved(0.3, -0.2, 0.1));
  ContactSet set = scene.contacts(pair);
  // So few that no cover is made.
  std::erase_if(set.contacts, [](const Contact& c) { return c.dimension == 1; });
  ContactSet as_it_is = set;
  ASSERT_EQ(testing::joined(pair, as_it_is).size(), 1u);
  const auto corner = std::ranges::find(set.contacts, VERTEX, [](const Contact& c) { return c.moving.kind; });
  ASSERT_NE(corner, set.contacts.end());
  corner->direction = Vec3(0.1, 0.0, -1.0).normalized();
  const LmdSet two = testing::joined(pair, set);
  ASSERT_EQ(two.size(), 2u) << text(two);
  EXPECT_NE(two[0].feature_moving.kind, two[1].feature_moving.kind);
}

TEST(JoinContacts, TheFacesOfAStepAreTwoLmdsAndALevelRecessIsNone) {
  // Undersides at the heights .2 and .1, as a prism along y.
  const auto step = [] {
    return merged(translated(make_box({1.0, 1.0, 1.0}), Vec3(0.5, 0.5, 0.7)),
                  translated(make_box({1.0, 1.0, 1.1}), Vec3(1.5, 0.5, 0.65)));
  };
  ShapeScene two(step(), square_table());
  LmdSet lmds = two.lmds(Pose{});
  std::ranges::sort(lmds, lmd_less);
  ASSERT_EQ(lmds.size(), 2u) << text(lmds);
  EXPECT_NEAR(lmds[0].distance, 0.1, 1e-14);
  EXPECT_NEAR((lmds[0].point_moving - Vec3(1.5, 0.5, 0.1)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(lmds[1].distance, 0.2, 1e-14);
  EXPECT_NEAR((lmds[1].point_moving - Vec3(0.5, 0.5, 0.2)).norm(), 0.0, 1e-13);

  // A sheet, bent up in the middle: a level recess from whose border the distance only decreases.
  TriangleMesh pan;
  for (const double side : {1.0, 0.5})
    for (int k = 0; k < 4; ++k) {
      const double x = k == 1 || k == 2 ? side : -side, y = k > 1 ? side : -side;
      pan.vertices.emplace_back(x, y, side == 1.0 ? 0.1 : 0.3);
    }
  for (std::int32_t k = 0; k < 4; ++k) {
    const std::int32_t n = (k + 1) % 4;
    pan.triangles.push_back({k, 4 + k, n});
    pan.triangles.push_back({n, 4 + k, 4 + n});
  }
  pan.triangles.push_back({4, 6, 5});
  pan.triangles.push_back({4, 7, 6});
  ShapeScene recess(pan, square_table());
  const LmdSet of_pan = recess.lmds(Pose{});
  // The recess's level border alone has contacts: one place, four segments, at .1.
  for (const Lmd& lmd : of_pan) EXPECT_NEAR(lmd.distance, 0.1, 1e-13) << text(of_pan);
  EXPECT_GE(of_pan.size(), 1u);
  for (const double tilt : {1e-12, 1e-9, 1e-8, 1e-4}) {
    const LmdSet of_tilted = recess.lmds(turned_by(tilt, Vec3(1.0, 0.3, 0.0), Vec3::Zero()));
    EXPECT_GE(of_tilted.size(), 1u) << tilt;
    for (const Lmd& lmd : of_tilted) EXPECT_LT(lmd.distance, 0.2) << tilt;
  }
}

/// Strips beside the lowest strip of a cylinder are higher by more than the tolerance.
TEST(JoinContacts, OfACylinderTheLowestFacetCounts) {
  TriangleMesh cylinder = make_sleeve(circle_outline(0.5), nullptr, {1.0, 256, 1, 1});
  // The cylinder lies on a facet.
  const double half = std::numbers::pi / 256.0;
  const double inradius = 0.5 * std::cos(half);
  cylinder = testing::placed(std::move(cylinder), turned_by(half, Vec3::UnitZ(), Vec3::Zero()));
  cylinder =
      testing::placed(std::move(cylinder), turned_by(0.5 * std::numbers::pi, Vec3::UnitY(), Vec3::Zero()));
  ShapeScene scene(cylinder, square_table());
  const Lmd lmd = only(scene, moved(0.2, 0.3, inradius + 0.05));
  EXPECT_NEAR(lmd.distance, 0.05, 1e-8);
  EXPECT_NEAR((lmd.point_fixed - Vec3(0.2, 0.3, 0.0)).norm(), 0.0, 1e-6);
  // The cylinder lies on an edge.
  const Lmd edge = only(scene, turned_by(half, Vec3::UnitX(), Vec3(0.2, 0.3, 0.5 + 0.05)));
  EXPECT_NEAR(edge.distance, 0.05, 1e-8);
  EXPECT_EQ(edge.feature_moving.kind, EDGE);
}

TEST(JoinContacts, OfARingItIsTheMiddleOfTheHole) {
  ShapeScene scene(make_sleeve(circle_outline(0.5), circle_outline(0.3), {0.4, 24, 1, 2}), square_table());
  LmdSet lmds = scene.lmds(moved(0.1, -0.2, 0.25));
  ASSERT_EQ(lmds.size(), 1u) << text(lmds);
  EXPECT_NEAR((lmds[0].point_fixed - Vec3(0.1, -0.2, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(lmds[0].distance, 0.05, 1e-13);
  EXPECT_EQ(lmds[0].feature_moving.kind, FACE);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FACE);
}

TEST(JoinContacts, ACheckerboardsSquaresAreOneLmdAndSquaresApartAreNot) {
  ShapeScene touching(sheet_of({"#.", ".#"}, 0.5, false), square_table());
  const LmdSet one = touching.lmds(moved(0.3, 0.1, 0.05));
  ASSERT_EQ(one.size(), 1u) << text(one);
  EXPECT_NEAR((one[0].point_fixed - Vec3(0.3, 0.1, 0.0)).norm(), 0.0, 1e-13) << "the corner of both";
  ShapeScene apart(sheet_of({"#.#"}, 0.5, false), square_table());
  EXPECT_EQ(apart.lmds(moved(0.3, 0.1, 0.05)).size(), 2u);
}

TEST(JoinContacts, TwoRegionsOfOnePlaneAreOneLmd) {
  // Two halves of a face at an angle below the tolerance, with a chain between them.
  const auto bent = [](double angle) {
    TriangleMesh mesh = sheet_of({"##"}, 1.0, false);
    for (Vec3& x : mesh.vertices) x.z() = angle * std::max(0.0, x.x());
    return mesh;
  };
  for (const double angle : {2e-10, -2e-10}) {
    ShapeScene scene(bent(angle), square_table());
    ASSERT_EQ(scene.shape_moving().regions.region_count(), 2);
    const LmdSet lmds = scene.lmds(moved(0.1, 0.2, 0.05));
    ASSERT_EQ(lmds.size(), 1u) << angle << "\n" << text(lmds);
    EXPECT_NEAR((lmds[0].point_fixed - Vec3(0.1, 0.2, 0.0)).norm(), 0.0, 1e-9);
    EXPECT_EQ(lmds[0].feature_moving.kind, FACE);
  }
}

TEST(JoinContacts, AChainOverTwoTeethIsOneLmdATooth) {
  const TriangleMesh teeth = merged(translated(make_box({0.04, 1.0, 1.0}), Vec3(0.02, 0.0, -0.5)),
                                    translated(make_box({0.04, 1.0, 1.0}), Vec3(0.17, 0.0, -0.5)));
  ShapeScene scene(edge_down(), teeth);
  for (const double tilt : {0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4, 1e-3}) {
    SCOPED_TRACE(tilt);
    LmdSet lmds = scene.lmds(turned_by(tilt, Vec3::UnitY(), Vec3(0.0, 0.0, 0.01)));
    ASSERT_EQ(lmds.size(), 2u) << text(lmds);
    std::ranges::sort(lmds, {}, [](const Lmd& lmd) { return lmd.point_fixed.x(); });
    const double known = scene.at(Pose{}).tolerance.known;
    // The middle while the change over a tooth is within the tolerance, then the lower, far end.
    const bool is_level = 0.04 * tilt <= known;
    EXPECT_NEAR(lmds[0].point_fixed.x(), is_level ? 0.02 : 0.04, 1e-4);
    EXPECT_NEAR(lmds[1].point_fixed.x(), is_level ? 0.17 : 0.19, 1e-4);
  }
}

/// What is left of the contacts that scene has at a pose, joined.
template <typename IsLeftOut>
std::size_t count_without(ShapeScene& scene, const Pose& pose, IsLeftOut&& is_left_out) {
  const ShapePair pair = scene.at(pose);
  ContactSet set = scene.contacts(pair);
  std::erase_if(set.contacts, is_left_out);
  return testing::joined(pair, set).size();
}

TEST(JoinContacts, AWayAlongALineLeadsOverThePlacesBetween) {
  // Over the second tooth only the ends are left: no way leads there from the first one.
  ShapeScene scene(edge_down(), sheet_of({"#.#", "#.#", "###"}, 0.4));
  const Pose pose = moved(0.0, 0.4, 0.05);
  const auto is_second_part = [](const Contact& c) { return c.dimension == 1 && c.point_fixed.x() > 0.0; };
  EXPECT_EQ(count_without(scene, pose, [](const Contact&) { return false; }), 2u);
  EXPECT_EQ(count_without(scene, pose, is_second_part), 2u);
}

TEST(JoinContacts, PlacesOnNoLineAreJoinedWhereverAWayLeads) {
  // Opposite corners of a square are over one arm of a bracket, a third one over the other arm.
  const double side = 0.8 * std::numbers::sqrt2;
  ShapeScene scene(translated(make_box({side, side, 0.4}), Vec3(0.0, 0.0, 0.2)),
                   sheet_of({"########", "#.......", "########"}, 0.4));
  for (const int quarters : {0, 1, 2, 3}) {
    const Pose pose =
        turned_by((0.25 + 0.5 * quarters) * std::numbers::pi, Vec3::UnitZ(), Vec3(0.5, -0.4, 0.05));
    EXPECT_EQ(count_without(scene, pose,
                            [](const Contact& c) { return c.moving.kind != VERTEX || c.fixed.kind != FACE; }),
              2u)
        << quarters;
  }
}

TEST(JoinContacts, ATiltedBoxIsRepresentedOnItsFeatureAtEveryTilt) {
  std::mt19937_64 random(3);
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(4)}) {
    ShapeScene scene(box(2), testing::placed(square_table(), whole));
    const double known = scene.at(whole).tolerance.known;
    for (int i = 0; i < 300; ++i) {
      const double tilt = std::pow(10.0, -13.0 + 11.0 * uniform(random));
      const double angle = i % 3 == 0 ? 0.5 * std::numbers::pi * (i % 4) : 6.28 * uniform(random);
      const Vec3 axis(std::cos(angle), std::sin(angle), 0.0);
      const double gap = 0.02 + 0.1 * uniform(random);
      SCOPED_TRACE(::testing::Message() << "tilt " << tilt << " about " << axis.transpose());
      // `only` checks that the point is on its feature.
      const Lmd lmd = only(scene, whole * turned_by(tilt, axis, Vec3(0.0, 0.0, gap)));
      const double lowest = 0.5 * tilt * (std::abs(axis.x()) + std::abs(axis.y()));
      EXPECT_NEAR(lmd.distance, gap - lowest, known + 1.1 * lowest * tilt) << "continuous";
    }
    // The middle, then the lower edge or the corner.
    const auto kind_at = [&](double tilt, const Vec3& axis) {
      return only(scene, whole * turned_by(tilt, axis, Vec3(0.0, 0.0, 0.1))).feature_moving.kind;
    };
    EXPECT_EQ(kind_at(0.9 * known, Vec3::UnitX()), FACE);
    EXPECT_EQ(kind_at(1.1 * known, Vec3::UnitX()), EDGE);
    EXPECT_EQ(kind_at(1e-4, Vec3::UnitX()), EDGE);
    EXPECT_EQ(kind_at(0.6 * known, Vec3(1.0, 1.0, 0.0)), FACE);
    EXPECT_EQ(kind_at(1e-6, Vec3(1.0, 1.0, 0.0)), VERTEX);
  }
}

TEST(JoinContacts, ACornerOverABorderOfTwoFacesIsOneLmd) {
  // Two faces that are coplanar but for 1e-6.
  TriangleMesh roof = sheet_of({"##"}, 1.0);
  for (Vec3& x : roof.vertices) x.z() = -1e-6 * std::abs(x.x());
  TriangleMesh cube = translated(make_box({1.0, 1.0, 1.0}), Vec3(0.5, 0.5, 0.5));
  cube =
      testing::placed(std::move(cube),
                      {Vec3::Zero(), Eigen::Quaterniond::FromTwoVectors(Vec3(1.0, 1.0, 1.0), Vec3::UnitZ())});
  ShapeScene scene(cube, roof);
  for (const double x : {0.0, 1e-16, -1e-14, 1e-13, 1e-12, 1e-9, 1e-7, -1e-6, 1e-3}) {
    SCOPED_TRACE(x);
    const LmdSet lmds = scene.lmds(moved(x, 0.1, 0.05));
    ASSERT_EQ(lmds.size(), 1u) << text(lmds);
    EXPECT_EQ(lmds[0].feature_moving.kind, VERTEX);
    EXPECT_NEAR(lmds[0].distance, 0.05, 1e-8);
  }
}

TEST(JoinContacts, TheCutoffIsAskedAfterJoining) {
  ShapeScene scene(box(), square_table(), 0.1);
  EXPECT_EQ(scene.lmds(moved(0.0, 0.0, 0.1 - 1e-12)).size(), 1u);
  EXPECT_EQ(scene.lmds(moved(0.0, 0.0, 0.1 + 1e-12)).size(), 0u) << "looked for, and beyond";
  // For a face that leans by less than the tolerance the middle counts.
  const double known = scene.at(Pose{}).tolerance.known;
  EXPECT_EQ(scene.lmds(turned_by(0.5 * known, Vec3::UnitX(), Vec3(0.0, 0.0, 0.1 - 0.01 * known))).size(), 1u);
}

/// The intersections of a box's bottom with the table's top.
std::vector<Intersection> bottom_on_top(const ShapeScene& scene) {
  std::vector<Intersection> intersections;
  for (std::int32_t t = 0; t < 12; ++t)
    for (std::int32_t s = 0; s < 12; ++s)
      if (scene.moving().face_normals[static_cast<std::size_t>(t)].z() < -0.5 &&
          scene.fixed().face_normals[static_cast<std::size_t>(s)].z() > 0.5)
        intersections.push_back({{FACE, t}, {FACE, s}, t, s, 0, 2, 0.5, Vec3(0.1, 0.2, 0.0)});
  EXPECT_EQ(intersections.size(), 4u);
  return intersections;
}

TEST(JoinContacts, WhatTouchesKeepsItsContactAndIntersectsNothing) {
  ShapeScene scene(box(), square_table());
  for (const double gap : {0.0, 1e-16, -1e-16}) {
    const ShapePair pair = scene.at(moved(0.1, 0.2, gap));
    ContactSet set = scene.contacts(pair);
    std::vector<Intersection> intersections = bottom_on_top(scene);
    LmdSet lmds;
    join_contacts(pair, 0, set, intersections, lmds);
    std::erase_if(lmds, [](const Lmd& lmd) { return lmd.distance > 1e-3; });
    EXPECT_TRUE(intersections.empty()) << gap;
    ASSERT_EQ(lmds.size(), 1u) << text(lmds);
    EXPECT_NEAR((lmds[0].direction + Vec3::UnitZ()).norm(), 0.0, 1e-15);
    EXPECT_NEAR((lmds[0].point_fixed - Vec3(0.1, 0.2, 0.0)).norm(), 0.0, 1e-13);
  }
}

TEST(JoinContacts, WhatIntersectsByMoreThanRoundingHasNoContactThere) {
  ShapeScene scene(box(), square_table());
  const ShapePair pair = scene.at(turned_by(4e-10, Vec3::UnitX(), Vec3(0.1, 0.2, 0.0)));
  ContactSet set = scene.contacts(pair);
  ASSERT_TRUE(std::ranges::any_of(set.contacts, [&](const Contact& contact) {
    return contact.dimension == 2 && contact.least_gap < -pair.tolerance.rounding;
  })) << "one side is below the table by less than the tolerance";
  std::vector<Intersection> intersections = bottom_on_top(scene);
  LmdSet lmds;
  join_contacts(pair, 0, set, intersections, lmds);
  EXPECT_EQ(intersections.size(), 4u);
  for (const Lmd& lmd : lmds) EXPECT_GT(lmd.distance, 1e-3) << text(lmds);
}

TEST(JoinContacts, WhatTouchesWithoutAPairOfPointsIntersects) {
  // Rule S needs a point contact to replace an intersection, and none is left.
  ShapeScene scene(box(), square_table());
  const ShapePair pair = scene.at(moved(0.1, 0.2, 0.0));
  ContactSet set = scene.contacts(pair);
  std::erase_if(set.contacts, [](const Contact& contact) { return contact.dimension == 0; });
  std::vector<Intersection> intersections = bottom_on_top(scene);
  LmdSet lmds;
  join_contacts(pair, 0, set, intersections, lmds);
  EXPECT_EQ(intersections.size(), 4u);
}

TEST(JoinContacts, TrianglesThatAddNothingChangeNoLmd) {
  std::mt19937_64 random(7);
  const TriangleMesh blob = make_blob(0.5, 0.1, 2), box = make_box({0.7, 0.7, 0.7}, 2);
  ShapeScene clean(blob, box, 0.3), flawed(with_zero_areas(blob, 4), with_zero_areas(box, 3), 0.3);
  std::size_t found = 0;
  for (int k = 0; k < 20; ++k) {
    const Pose pose = testing::pose_of_seed(random());
    const Pose apart{1.05 * pose.translation.normalized(), pose.rotation};
    LmdSet expected = clean.lmds(apart), lmds = flawed.lmds(apart);
    std::ranges::sort(expected, lmd_less);
    std::ranges::sort(lmds, lmd_less);
    found += expected.size();
    ASSERT_EQ(lmds.size(), expected.size()) << text(apart);
    for (std::size_t i = 0; i < lmds.size(); ++i) {
      EXPECT_TRUE(same_feature_pair(lmds[i], expected[i])) << text(lmds) << "expected\n" << text(expected);
      EXPECT_NEAR((lmds[i].point_fixed - expected[i].point_fixed).norm(), 0.0, 1e-14);
    }
  }
  EXPECT_GT(found, 12u);
}

}  // namespace
}  // namespace lmdbench
