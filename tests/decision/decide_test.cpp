// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/polar_condition.h>

#include <gtest/gtest.h>
#include <support/rounded.h>
#include <support/shape_scene.h>
#include <support/sheets.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Each row of the table of DEFINITION.md, and that it holds at its boundary.
namespace lmdbench {
namespace {

using testing::edge_down;
using testing::make_body;
using testing::moved;
using testing::ShapeScene;
using testing::sheet_of;
using testing::turned_by;
using testing::uniform;

/// Kinds of both features and the dimension, for messages and comparisons: "VE0".
std::string kind_of(const Contact& contact) {
  const auto letter = [](FeatureKind kind) {
    return kind == FeatureKind::VERTEX ? 'V' : kind == FeatureKind::EDGE ? 'E' : 'F';
  };
  return {letter(contact.moving.kind), letter(contact.fixed.kind),
          static_cast<char>('0' + contact.dimension)};
}

/// All contacts nearer than a distance, sorted.
std::vector<std::string> kinds_of(const ContactSet& set, double nearer_than) {
  std::vector<std::string> kinds;
  for (const Contact& contact : set.contacts)
    if (contact.distance < nearer_than) kinds.push_back(kind_of(contact));
  std::ranges::sort(kinds);
  return kinds;
}
using Kinds = std::vector<std::string>;

/// Invariants of every contact.
void expect_sound(const ShapePair& pair, const ContactSet& set) {
  for (const Contact& c : set.contacts) {
    SCOPED_TRACE(kind_of(c));
    EXPECT_NEAR((c.point_fixed - c.point_moving).norm(), c.distance, 1e-14);
    EXPECT_LE(c.distance, pair.tolerance.reach + pair.tolerance.known);
    EXPECT_NEAR(c.direction.norm(), 1.0, 1e-12);
    if (c.distance > 1e-4) {
      EXPECT_NEAR(((c.point_fixed - c.point_moving) / c.distance - c.direction).norm(), 0.0, 1e-5);
    }
    EXPECT_LE(c.least_gap, c.distance + 1e-14);
    if (c.dimension == 1) {
      EXPECT_NEAR((0.5 * (c.ends_moving[0] + c.ends_moving[1]) - c.point_moving).norm(), 0.0, 1e-14);
      EXPECT_NEAR((0.5 * (c.ends_fixed[0] + c.ends_fixed[1]) - c.point_fixed).norm(), 0.0, 1e-14);
      EXPECT_NEAR((c.ends_moving[1] - c.ends_moving[0]).norm(), c.measure, 1e-7);
    }
    double area = 0.0;
    for (const ConvexPolygon& piece : set.pieces_of(c)) area += piece.measure().area;
    EXPECT_NEAR(area, c.dimension == 2 ? c.measure : 0.0, 1e-13);
  }
}

/// A box that stands on its lowest corner, which is at the origin.
TriangleMesh on_a_corner() {
  TriangleMesh mesh = translated(make_box({1.0, 1.0, 1.0}), Vec3(0.5, 0.5, 0.5));
  Pose pose;
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(Vec3(1.0, 1.0, 1.0), Vec3::UnitZ());
  return testing::placed(std::move(mesh), pose);
}

/// Box under the plane z = 0, [-1, 1]^2 wide.
TriangleMesh table() {
  return translated(make_box({2.0, 2.0, 1.0}), Vec3(0.0, 0.0, -0.5));
}

const std::vector<double> OFFSETS{0.0, 1e-16, 1e-15, 1e-12, 1e-11, 1e-9, 1e-7, 1e-5};

TEST(Decide, ACornerOverAFaceItsEdgeAndItsCorner) {
  ShapeScene scene(on_a_corner(), table());
  const double gap = 0.1;
  EXPECT_EQ(kinds_of(scene.contacts(moved(0.3, -0.2, gap)), 0.5), Kinds{"VF0"});
  EXPECT_EQ(kinds_of(scene.contacts(moved(1.02, -0.2, gap)), 0.5), Kinds{"VE0"});
  EXPECT_EQ(kinds_of(scene.contacts(moved(1.02, -1.03, gap)), 0.5), Kinds{"VV0"});
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(3)}) {
    ShapeScene placed(on_a_corner(), testing::placed(table(), whole));
    for (const double x : OFFSETS)
      for (const double y : OFFSETS)
        for (const double sign_x : {-1.0, 1.0})
          for (const double sign_y : {-1.0, 1.0}) {
            const double out_x = sign_x * x, out_y = sign_y * y;
            const ShapePair pair = placed.at(whole * moved(1.0 + out_x, 1.0 + out_y, gap));
            const ContactSet set = placed.contacts(pair);
            expect_sound(pair, set);
            const Kinds kinds = kinds_of(set, 0.5);
            SCOPED_TRACE(::testing::Message() << out_x << " " << out_y);
            // A condition is clear by more than rounding: wings are 2 long, the distance is .1.
            const double unsure = 30.0 * pair.tolerance.rounding;
            const auto count = [&](const char* kind) { return std::ranges::count(kinds, kind); };
            const auto expect = [&](bool yes, bool no, const char* kind) {
              if (yes) {
                EXPECT_GE(count(kind), 1) << kind;
              }
              if (no) {
                EXPECT_EQ(count(kind), 0) << kind;
              }
            };
            const double lower = std::min(out_x, out_y), upper = std::max(out_x, out_y);
            expect(upper <= 0.0, upper > unsure, "VF0");
            expect(upper >= 0.0 && lower <= 0.0, upper < -unsure || lower > unsure, "VE0");
            expect(lower >= 0.0, lower < -unsure, "VV0");
            EXPECT_GE(kinds.size(), 1u) << "nothing is lost";
          }
  }
}

/// A tetrahedron on its tip at the origin, whose cone has nearly all downward directions.
TriangleMesh needle() {
  return {{{0, 0, 0}, {0.02, 0, 1}, {-0.01, 0.017, 1}, {-0.01, -0.017, 1}},
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
}

TEST(Decide, TheEndOfAHolesSideIsNoPlaceToStopAt) {
  // A point above one side of the hole, whose nearest point on another side is that side's end. The
  // border turns inwards there, so the distance decreases along it, to the point below.
  const TriangleMesh plate =
      make_sleeve(polygon_outline(4, 1.0), polygon_outline(4, 0.25), {.height = 0.5, .around = 4});
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(5)}) {
    ShapeScene scene(needle(), testing::placed(plate, whole));
    std::vector<Vec3> hole;
    for (const Vec3& v : plate.vertices)
      if (v.z() > 0.0 && v.head<2>().norm() < 0.5) hole.push_back(v);
    ASSERT_EQ(hole.size(), 4u);
    std::ranges::sort(hole, {}, [](const Vec3& v) { return std::atan2(v.y(), v.x()); });
    for (std::size_t k = 0; k < 4; ++k)
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 end = hole[k], next = hole[sign > 0.0 ? (k + 1) % 4 : (k + 3) % 4];
        const Vec3 p = end + 0.2 * (next - end) + 0.01 * Vec3::UnitZ();
        const ContactSet set = scene.contacts(whole * moved(p.x(), p.y(), p.z()));
        // The only contact nearby is with the side below.
        std::size_t near = 0;
        for (const Contact& c : set.contacts) {
          if (c.moving.kind != FeatureKind::VERTEX || c.distance > 0.2) continue;
          ++near;
          EXPECT_NEAR(c.distance, 0.01, 1e-12) << kind_of(c);
        }
        EXPECT_GE(near, 1u);
      }
  }
}

TEST(Decide, ACornerBelowAFaceHasNoContactWithIt) {
  ShapeScene scene(on_a_corner(), table());
  for (const double depth : {1e-9, 1e-3, 0.3})
    EXPECT_EQ(std::ranges::count(kinds_of(scene.contacts(moved(0.0, 0.0, -depth)), 1e9), "VF0"), 0) << depth;
  // Down to distance 0 the contact exists and has its direction.
  for (const double height : {0.0, 1e-15, 1e-12, 1e-7}) {
    const ContactSet set = scene.contacts(moved(0.25, 0.0, height));
    const auto found =
        std::ranges::find_if(set.contacts, [](const Contact& c) { return kind_of(c) == "VF0"; });
    ASSERT_NE(found, set.contacts.end()) << height;
    EXPECT_NEAR((found->direction + Vec3::UnitZ()).norm(), 0.0, 1e-15);
    EXPECT_NEAR(found->distance, height, 1e-15);
  }
}

/// The bar below, edge up.
TriangleMesh edge_up() {
  return testing::placed(edge_down(), {Vec3::Zero(), Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0)});
}

/// Contacts of a kind nearer than 0.4, of a set that is sound.
std::vector<Contact> near_contacts(ShapeScene& scene, const Pose& pose, const std::string& kind) {
  const ShapePair pair = scene.at(pose);
  const ContactSet set = scene.contacts(pair);
  expect_sound(pair, set);
  std::vector<Contact> found;
  for (const Contact& c : set.contacts)
    if (kind_of(c) == kind && c.distance < 0.4) found.push_back(c);
  return found;
}

TEST(Decide, ChainsThatCrossUpToTheirEnds) {
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(4)}) {
    ShapeScene scene(edge_down(), testing::placed(edge_up(), whole));
    for (const double angle : {0.5 * std::numbers::pi, 0.3, 1e-2, 1e-4, 1e-6}) {
      // The crossing moves along the moving chain and beyond its end.
      for (const double beyond : {-0.5, -1e-3, -1e-9, 0.0, 1e-9, 1e-3}) {
        const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
        Pose pose = turned_by(angle, Vec3::UnitZ(), -(1.0 + beyond) * along + Vec3(0.2, 0.0, 0.05));
        const ShapePair pair = scene.at(whole * pose);
        const ContactSet set = scene.contacts(pair);
        expect_sound(pair, set);
        const auto crossings = std::ranges::count_if(set.contacts, [](const Contact& c) {
          return kind_of(c) == "EE0" && std::abs(c.distance - 0.05) < 1e-12;
        });
        // The gap times the error of the common perpendicular, and the error of each place.
        const double sine = std::sin(angle),
                     unsure = 4.0 * pair.tolerance.rounding * (1.0 + 0.05 / sine) / sine;
        SCOPED_TRACE(::testing::Message() << "angle " << angle << " beyond " << beyond);
        if (beyond < -unsure || (beyond == 0.0 && angle > 1e-3)) {
          EXPECT_EQ(crossings, 1);
        }
        if (beyond > unsure) {
          EXPECT_EQ(crossings, 0);
        }
        EXPECT_FALSE(kinds_of(set, 0.0501).empty()) << "the end answers where the crossing does not";
      }
    }
  }
}

TEST(Decide, ChainsThatPassSideBySideShareNothing) {
  // Nearly parallel chains; the feet of the common perpendicular are far beyond the ends.
  ShapeScene scene(edge_down(), edge_up());
  for (const double angle : {1e-6, 1e-4, 1e-2}) {
    const ContactSet set = scene.contacts(turned_by(angle, Vec3::UnitZ(), Vec3(0.0, 0.3, 0.05)));
    EXPECT_EQ(std::ranges::count_if(
                  set.contacts, [](const Contact& c) { return kind_of(c) == "EE0" && c.distance < 0.06; }),
              0)
        << angle;
  }
}

TEST(Decide, ParallelChainsShareWhereTheyFaceEachOther) {
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(5)}) {
    ShapeScene scene(edge_down(), testing::placed(edge_up(), whole));
    const auto segments = [&](const Pose& pose) { return near_contacts(scene, whole * pose, "EE1"); };
    for (const double shift : {0.0, 0.5, -1.25, 1.999, 2.0 - 1e-9}) {
      const auto found = segments(moved(shift, 0.0, 0.05));
      ASSERT_EQ(found.size(), 1u) << shift;
      EXPECT_NEAR(found[0].measure, 2.0 - std::abs(shift), 1e-13);
      EXPECT_NEAR(found[0].distance, 0.05, 1e-14);
      const Vec3 middle = whole.inverse().rotation * (found[0].point_fixed - whole.translation);
      EXPECT_NEAR((middle - Vec3(0.5 * shift, 0.0, 0.0)).norm(), 0.0, 1e-13);
    }
    EXPECT_TRUE(segments(moved(2.0, 0.0, 0.05)).empty()) << "end over end";
    EXPECT_TRUE(segments(moved(2.1, 0.0, 0.05)).empty());
    // Also turned half round; the gap vector may change by less than the tolerance, not by more.
    EXPECT_EQ(segments(turned_by(std::numbers::pi, Vec3::UnitZ(), Vec3(0.0, 0.0, 0.05))).size(), 1u);
    const double known = scene.at(whole).tolerance.known;
    for (const Vec3& axis : {Vec3(0.0, 0.0, 1.0), Vec3(0.0, 1.0, 0.0)}) {
      EXPECT_EQ(segments(turned_by(0.45 * known, axis, Vec3(0.0, 0.0, 0.05))).size(), 1u);
      EXPECT_TRUE(segments(turned_by(0.55 * known, axis, Vec3(0.0, 0.0, 0.05))).empty());
      // The change over the common part counts, not that over the whole chain.
      EXPECT_EQ(segments(turned_by(0.9 * known, axis, Vec3(1.0, 0.0, 0.05))).size(), 1u);
    }
  }
}

TEST(Decide, AChainOverARegionSharesEachPartOfIt) {
  // Two teeth under a bar.
  const TriangleMesh teeth = merged(translated(make_box({0.2, 1.0, 1.0}), Vec3(-0.5, 0.0, -0.5)),
                                    translated(make_box({0.4, 1.0, 1.0}), Vec3(0.5, 0.0, -0.5)));
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(6)}) {
    ShapeScene scene(edge_down(), testing::placed(teeth, whole));
    const auto segments = [&](const Pose& pose) {
      std::vector<double> lengths;
      for (const Contact& c : near_contacts(scene, whole * pose, "EF1")) lengths.push_back(c.measure);
      std::ranges::sort(lengths);
      return lengths;
    };
    auto lengths = segments(moved(0.0, 0.0, 0.1));
    ASSERT_EQ(lengths.size(), 2u);
    EXPECT_NEAR(lengths[0], 0.2, 1e-13);
    EXPECT_NEAR(lengths[1], 0.4, 1e-13);
    // Tilted about y: the change over each tooth counts, not the change between the teeth.
    const double known = scene.at(whole).tolerance.known;
    EXPECT_EQ(segments(turned_by(2.3 * known, Vec3::UnitY(), Vec3(0.0, 0.0, 0.1))).size(), 2u);
    lengths = segments(turned_by(2.7 * known, Vec3::UnitY(), Vec3(0.0, 0.0, 0.1)));
    ASSERT_EQ(lengths.size(), 1u);
    EXPECT_NEAR(lengths[0], 0.2, 1e-7);
    EXPECT_TRUE(segments(turned_by(5.5 * known, Vec3::UnitY(), Vec3(0.0, 0.0, 0.1))).empty());
    // The chain lies along a border of the teeth; the border is included.
    EXPECT_EQ(segments(moved(0.0, 0.5, 0.1)).size(), 2u);
    EXPECT_EQ(segments(moved(0.0, 0.5 + 1e-12, 0.1)).size(), 0u);
    // Rolled about its own line, the bar has the contacts of the chain, until a face is level.
    const auto rolled = [&](double angle) {
      return segments(turned_by(angle, Vec3::UnitX(), Vec3(0.0, 0.0, 0.1))).size();
    };
    EXPECT_EQ(rolled(0.25 * std::numbers::pi - 1e-6), 2u);
    EXPECT_EQ(rolled(0.25 * std::numbers::pi + 1e-6), 0u);
  }
}

TEST(Decide, RegionsShareEachConnectedPartOfTheirOverlap) {
  for (const Pose& whole : {Pose{}, testing::pose_of_seed(7)}) {
    // Two feet over a table.
    ShapeScene scene(translated(make_two_boxes({0.25, 0.5, 0.5}, 0.5), Vec3(0.0, 0.0, 0.25)),
                     testing::placed(table(), whole));
    const auto polygons = [&](const Pose& pose) { return near_contacts(scene, whole * pose, "FF2"); };
    auto found = polygons(moved(0.1, 0.2, 0.01));
    ASSERT_EQ(found.size(), 2u) << "a region a foot: no face joins them";
    for (const Contact& c : found) {
      EXPECT_NEAR(c.measure, 0.125, 1e-13);
      EXPECT_NEAR(c.distance, 0.01, 1e-14);
      const Vec3 p = whole.rotation.conjugate() * (c.point_fixed - whole.translation);
      EXPECT_NEAR(std::abs(p.x() - 0.1), 0.375, 1e-13);
      EXPECT_NEAR(p.y(), 0.2, 1e-13);
      EXPECT_NEAR((whole.rotation.conjugate() * c.direction + Vec3::UnitZ()).norm(), 0.0, 1e-15);
    }
    // The change of height over each foot counts.
    const double known = scene.at(whole).tolerance.known;
    const auto tilted = [&](double tilt) {
      return polygons(turned_by(tilt, Vec3::UnitY(), Vec3(0.0, 0.0, 0.01))).size();
    };
    EXPECT_EQ(tilted(3.8 * known), 2u) << "a quarter wide";
    EXPECT_EQ(tilted(4.2 * known), 0u);
    // An overlap narrower than half the tolerance is no contact.
    EXPECT_EQ(polygons(moved(1.5 - 0.6 * known, 0.0, 0.01)).size(), 1u);
    EXPECT_EQ(polygons(moved(1.5 - 0.4 * known, 0.0, 0.01)).size(), 0u);
    EXPECT_EQ(polygons(moved(1.5, 0.0, 0.01)).size(), 0u);
    EXPECT_EQ(polygons(moved(0.0, 0.0, -0.01)).size(), 0u) << "behind each other";
    EXPECT_EQ(polygons(moved(0.0, 0.0, 0.0)).size(), 2u) << "down to touch";
  }
}

TEST(Decide, ASheetWithALargeHoleHasOnePartAndACombSeveral) {
  ShapeScene ring(sheet_of({"####", "#..#", "####"}, 0.25, false), table());
  const auto polygons = [](const ContactSet& set) {
    return std::ranges::count_if(set.contacts, [](const Contact& c) { return c.dimension == 2; });
  };
  const ContactSet on_ring = ring.contacts(moved(0.1, 0.0, 0.1));
  EXPECT_EQ(polygons(on_ring), 1);
  for (const Contact& c : on_ring.contacts)
    if (c.dimension == 2) {
      EXPECT_NEAR((c.point_fixed - Vec3(0.1, 0.0, 0.0)).norm(), 0.0, 1e-14) << "amid the hole";
      EXPECT_NEAR(c.measure, 10.0 * 0.0625, 1e-14);
    }
  // The teeth of a comb are over the border of the table; its back is outside.
  ShapeScene comb(sheet_of({"#.#.#", "#.#.#", "#####"}, 0.25, false), table());
  EXPECT_EQ(polygons(comb.contacts(moved(0.0, -1.2, 0.1))), 3);
  EXPECT_EQ(polygons(comb.contacts(moved(0.0, 0.0, 0.1))), 1);
}

TEST(Decide, SaddlesPitsAndReflexChainsShareNothing) {
  // The inner edge of an L and a corner that comes near it from outside.
  const Surface surface = build_surface(make_l_block(1.0));
  const ShapeComplex shape = ShapeComplex::of(surface);
  ShapeScene scene(on_a_corner(), make_l_block(1.0));
  std::mt19937_64 random(8);
  std::size_t contacts = 0, edges = 0;
  for (int i = 0; i < 200; ++i) {
    Pose pose = testing::pose_of_seed(random());
    pose.translation *= 2.0;
    const ShapePair pair = scene.at(pose);
    const ContactSet set = scene.contacts(pair);
    expect_sound(pair, set);
    contacts += set.contacts.size();
    for (const Contact& c : set.contacts) {
      if (c.fixed.kind != FeatureKind::EDGE) continue;
      ++edges;
      const auto triangles = surface.adjacency.edge_triangles[shape.lead_of_chain(c.fixed.index)];
      const Vec3 n0 = surface.face_normals[static_cast<std::size_t>(triangles[0])];
      const Triangle other = surface.mesh.triangle(triangles[1]);
      double highest = -1.0;
      for (const Vec3& x : other)
        highest = std::max(highest, n0.dot(x - surface.mesh.triangle(triangles[0])[0]));
      EXPECT_LE(highest, 1e-12) << "a reflex chain has no cone";
    }
  }
  EXPECT_GT(contacts, 50u);
  EXPECT_GT(edges, 5u);
}

TEST(Decide, PlacesThatCoincideHaveTheContactsOfThoseThatTouch) {
  // Rounding says whether points are at one place or just not, and in which direction.
  struct Case {
    TriangleMesh moving, fixed;
    Pose pose;
    const char* kind;
  };
  const TriangleMesh cube = make_box({1.0, 1.0, 1.0});
  const Case cases[] = {
      {cube, cube, moved(1.0, 1.0, 1.0), "VV0"},
      {cube, cube, moved(1.0, 0.25, 1.0), "EE1"},
      {on_a_corner(), cube, moved(0.5, 0.125, 0.5), "VE0"},
      {edge_down(), edge_up(), turned_by(1.0, Vec3::UnitZ(), Vec3::Zero()), "EE0"},
      {edge_down(), sheet_of({"#"}, 4.0), turned_by(1.0, Vec3::UnitZ(), Vec3(2.0, 0.1, 0.0)), "EE0"},
      {edge_down(), sheet_of({"#"}, 4.0, false), turned_by(1.0, Vec3::UnitZ(), Vec3(2.0, 0.1, 0.0)), "EE0"}};
  for (const Case& one : cases)
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      SCOPED_TRACE(::testing::Message() << one.kind << " seed " << seed);
      const Pose whole = seed == 0 ? Pose{} : testing::pose_of_seed(seed);
      ShapeScene forward(one.moving, testing::placed(one.fixed, whole)),
          backward(testing::placed(one.fixed, whole), one.moving);
      const Pose pose = whole * one.pose;
      const ContactSet there = forward.contacts(pose), back = backward.contacts(pose.inverse());
      EXPECT_EQ(std::ranges::count(kinds_of(there, 1e-14), one.kind), 1);
      ASSERT_EQ(there.contacts.size(), back.contacts.size());
      for (const Contact& c : there.contacts)
        EXPECT_TRUE(std::ranges::any_of(back.contacts,
                                        [&](const Contact& d) {
                                          return d.moving == c.fixed && d.fixed == c.moving &&
                                                 d.dimension == c.dimension &&
                                                 (pose.rotation * d.direction + c.direction).norm() < 1e-9;
                                        }))
            << kind_of(c) << " along " << c.direction.transpose();
    }
}

TEST(Decide, BothWaysRoundTheContactsAreTheSame) {
  std::mt19937_64 random(9);
  const TriangleMesh a = make_l_block(1.0),
                     b = translated(make_two_boxes({0.5, 0.5, 0.5}, 0.25), {0.0, 0.0, 0.25});
  ShapeScene forward(a, b), backward(b, a);
  std::size_t compared = 0;
  for (int i = 0; i < 60; ++i) {
    Pose pose = i % 2 == 0 ? testing::pose_of_seed(random()) : moved(0.25 * uniform(random), 0.0, 1.1);
    pose.translation *= 1.5;
    const ContactSet there = forward.contacts(pose);
    const ContactSet back = backward.contacts(pose.inverse());
    ASSERT_EQ(there.contacts.size(), back.contacts.size());
    for (const Contact& c : there.contacts) {
      ++compared;
      EXPECT_TRUE(std::ranges::any_of(back.contacts, [&](const Contact& d) {
        return d.moving == c.fixed && d.fixed == c.moving && d.dimension == c.dimension &&
               std::abs(d.distance - c.distance) < 1e-13 &&
               (pose.rotation * d.point_fixed + pose.translation - c.point_moving).norm() < 1e-12;
      })) << kind_of(c);
    }
  }
  EXPECT_GT(compared, 100u);
}

TEST(Decide, WhatIsNoFeatureHasNoContact) {
  ShapeScene scene(make_box({1.0, 1.0, 1.0}, 2), table());
  const ShapePair pair = scene.at(moved(0.0, 0.0, 0.6));
  ContactSet set;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(scene.moving().mesh.vertices.size()); ++v)
    if (!scene.shape_moving().is_corner(v))
      for (const FeatureId& g : testing::leads_of(scene.fixed(), scene.shape_fixed()))
        decide(pair, {FeatureKind::VERTEX, v}, g, set);
  EXPECT_TRUE(set.contacts.empty()) << "vertices inside faces and edges";
  TriangleMesh loose = table();
  loose.vertices.emplace_back(0.0, 0.0, 0.05);
  ShapeScene with_loose(make_box({1.0, 1.0, 1.0}), loose);
  const ShapePair other = with_loose.at(moved(0.0, 0.0, 0.6));
  ContactSet with_vertex;
  for (const FeatureId& f : testing::leads_of(with_loose.moving(), with_loose.shape_moving()))
    decide(other, f, {FeatureKind::VERTEX, static_cast<std::int32_t>(loose.vertices.size()) - 1},
           with_vertex);
  EXPECT_TRUE(with_vertex.contacts.empty()) << "a vertex without triangles";
}

/// Needles have edges whose cone no side bounds: where they touch, their difference may be square
/// to the product of their directions. They make one LMD, however little they are turned.
TEST(PolarCondition, AnEdgeWithoutSidesLeavesItsDirectionOpen) {
  const auto needle = [] {
    return TriangleMesh{{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0)}, {{0, 1, 2}}};
  };
  ShapeScene scene(needle(), needle());
  for (const double turn : {1e-13, 3e-11, 1e-9}) {
    SCOPED_TRACE(turn);
    const Pose X_WM{Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vec3::UnitZ()))};
    const ContactSet set = scene.contacts(X_WM);
    EXPECT_TRUE(std::ranges::any_of(set.contacts, [](const Contact& c) {
      return c.dimension == 1 && c.distance > 0.0 && c.direction_error > 0.5;
    }));
    std::set<std::pair<FeatureId, FeatureId>> names;
    for (const Lmd& lmd : scene.lmds(X_WM))
      EXPECT_TRUE(names.emplace(lmd.feature_moving, lmd.feature_fixed).second) << "two of one name";
  }
}

TriangleMesh ridge() {
  return {{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(-1, 1, -1), Vec3(1, 1, -1), Vec3(-1, -1, -1), Vec3(1, -1, -1)},
          {{0, 1, 2}, {1, 3, 2}, {1, 0, 4}, {5, 1, 4}}};
}

FeatureId chain_along_x(const ShapeScene& of_ridges) {
  const std::int32_t along_x = of_ridges.moving().adjacency.triangle_edges[0][0];
  return {FeatureKind::EDGE, of_ridges.shape_moving().chain_of(along_x)};
}

/// Two ridges that nearly follow each other have one direction in common. Directions far beside it
/// still lie within a small error of both cones.
TEST(PolarCondition, NoDirectionIsKnownFarFromTheOneInCommon) {
  ShapeScene scene(ridge(), ridge());
  const FeatureId chain = chain_along_x(scene);
  const double error = 1e-3;
  const auto common = [&](const ShapePair& pair, const Vec3& u) {
    return common_direction(pair.moving, chain, pair.fixed, chain, u, error, 1e-15, 1e-12);
  };
  const Eigen::AngleAxisd turn(0.1, Vec3::UnitZ());
  const ShapePair from_above = scene.at({Vec3::Zero(), turn * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0)});
  const auto beside = [&](double errors) {
    return common(from_above, Eigen::AngleAxisd(errors * error, turn * Vec3::UnitX()) * Vec3(-Vec3::UnitZ()));
  };
  const auto near = beside(3.0);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->u.z(), -1.0, 1e-12);
  EXPECT_FALSE(beside(5.0));
  EXPECT_FALSE(common(scene.at(Pose{}), -Vec3::UnitZ())) << "both from below";
}

/// Square to both edges to rounding, however small their angle is.
TEST(PolarCondition, EdgesThatNearlyFollowEachOtherHaveOneDirection) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Pose whole = testing::pose_of_seed(seed);
    ShapeScene scene(ridge(), testing::placed(ridge(), whole));
    const FeatureId chain = chain_along_x(scene);
    for (const double turn : {1e-12, 1e-10, 1e-8, 1e-6}) {
      const Eigen::Quaterniond above =
          Eigen::AngleAxisd(turn, Vec3::UnitZ()) * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
      const ShapePair pair = scene.at(whole * Pose{Vec3::Zero(), above});
      const Vec3 down = whole.rotation * Vec3(-Vec3::UnitZ()),
                 u = whole.rotation * Vec3(0.003, 0.004, -1.0).normalized();
      const auto common =
          common_direction(pair.moving, chain, pair.fixed, chain, u, 0.01, pair.tolerance.rounding, 0.0);
      ASSERT_TRUE(common) << seed << " turned by " << turn;
      EXPECT_LE((common->u - down).norm(), 0.006) << seed << " turned by " << turn;
    }
  }
}

/// The fans of a vertex are a fact of the mesh. A decision that counted them again would look at
/// all triangles of a hub, once for every feature near it.
TEST(PolarCondition, LooksUpHowTrianglesHangTogether) {
  TriangleMesh pit = make_box({2, 2, 2});
  for (auto& corners : pit.triangles) std::swap(corners[0], corners[1]);
  Surface surface = build_surface(pit);
  const ShapeComplex shape = ShapeComplex::of(surface);
  const RigidTransform identity;
  const ShapeSide side{surface, shape, identity, false};
  const Vec3 away = surface.mesh.vertices[0].normalized();
  const PolarSlack exact;
  EXPECT_FALSE(admits(side, {FeatureKind::VERTEX, 0}, away, exact)) << "inside of the solid";
  surface.vertex_has_several_fans[0] = true;
  EXPECT_TRUE(admits(side, {FeatureKind::VERTEX, 0}, away, exact))
      << "no side is asked for where surfaces touch";
}

}  // namespace
}  // namespace lmdbench
