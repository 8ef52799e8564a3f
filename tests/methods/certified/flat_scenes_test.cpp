// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/flat_regions.h>
#include <lmdbench/shape/flatten.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <support/lmd_text.h>
#include <support/rounded.h>
#include <support/scenes.h>
#include <support/sheets.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <tuple>
#include <vector>

/// Flat contact: regions and straight edges must give the same sets as the triangles.
namespace lmdbench {
namespace {

using testing::make_scene;
using testing::random_direction;
using testing::text;
using testing::uniform;

/// The set has every LMD of the truth, with the same features and place, and no other.
void expect_same(const LmdSet& set, const LmdSet& truth, const Pose& pose) {
  SCOPED_TRACE(text(pose) + "\nset:\n" + text(set) + "truth:\n" + text(truth));
  ASSERT_EQ(set.size(), truth.size());
  std::vector<bool> used(set.size(), false);
  for (const Lmd& true_lmd : truth) {
    std::size_t partner = set.size();
    for (std::size_t i = 0; i < set.size() && partner == set.size(); ++i)
      if (!used[i] && same_feature_pair(set[i], true_lmd) && set[i].intersecting == true_lmd.intersecting &&
          std::abs(set[i].distance - true_lmd.distance) <= 1e-12 &&
          (set[i].point_moving - true_lmd.point_moving).norm() <= 1e-9 &&
          (set[i].point_fixed - true_lmd.point_fixed).norm() <= 1e-9)
        partner = i;
    ASSERT_LT(partner, set.size()) << "without a partner: " << text({true_lmd});
    used[partner] = true;
  }
}

/// Searches from scratch and, along a path, with results of earlier frames.
class FlatComparison {
 public:
  explicit FlatComparison(Scene scene)
      : scene_(std::move(scene)),
        truth_(make_method("exhaustive", scene_)),
        coherent_(make_method("certified", scene_)) {}

  void check(const Pose& pose) {
    const LmdSet truth = lmds_at(*truth_, pose);
    expect_same(lmds_at(*coherent_, pose), truth, pose);
    expect_same(lmds_at(*make_method("certified", scene_), pose), truth, pose);
    found_ += truth.size();
  }
  std::size_t found() const { return found_; }

 private:
  Scene scene_;
  std::unique_ptr<Method> truth_, coherent_;
  std::size_t found_ = 0;
};

Pose turned_on_top(std::mt19937_64& random, double height) {
  return {Vec3(0.16 * (uniform(random) - 0.5), 0.16 * (uniform(random) - 0.5), height),
          Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * std::numbers::pi * uniform(random), Vec3::UnitZ()))};
}

/// LMDBENCH_TILTED_POSES, or a few.
int tilted_poses(int few = 400) {
  const char* const wanted = std::getenv("LMDBENCH_TILTED_POSES");
  return wanted != nullptr ? std::atoi(wanted) : few;
}

TEST(FlatScenes, BoxesFaceToFace) {
  std::mt19937_64 random(1);
  for (const int cells : {1, 2, 5}) {
    FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, cells), make_box({0.1, 0.12, 0.1}, 3), 0.02));
    for (int i = 0; i < 40; ++i) boxes.check(turned_on_top(random, 0.11));
    EXPECT_GT(boxes.found(), 30u);
  }
}

TEST(FlatScenes, AlignedBoxesOfAllOffsets) {
  // Edges over edges, corners over corners, and coinciding triangulations.
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 2), make_box({0.1, 0.1, 0.1}, 2), 0.04));
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y)
      boxes.check({Vec3(0.025 * x, 0.025 * y, 0.11), Eigen::Quaterniond::Identity()});
  EXPECT_GT(boxes.found(), 100u);
}

TEST(FlatScenes, NonConvexFacesAndSeveralOverlaps) {
  std::mt19937_64 random(2);
  FlatComparison blocks(make_scene(make_l_block(0.1), make_two_boxes({0.08, 0.1, 0.1}, 0.02), 0.03));
  for (int i = 0; i < 40; ++i) {
    Pose pose = turned_on_top(random, 0.0);
    pose.rotation = pose.rotation * Eigen::AngleAxisd(0.5 * std::numbers::pi * (i % 4), Vec3::UnitX()) *
                    Eigen::AngleAxisd(0.5 * std::numbers::pi * (i % 3), Vec3::UnitY());
    pose.translation.z() = 0.11;
    blocks.check(pose);
  }
  EXPECT_GT(blocks.found(), 40u);
}

/// Expects LMDs of both methods at exactly these places on the fixed mesh [m].
void expect_contacts_at(const Scene& scene, const Pose& pose, const std::vector<Vec3>& places) {
  for (const char* method : {"exhaustive", "certified"}) {
    const LmdSet set = lmds_at(*make_method(method, scene), pose);
    SCOPED_TRACE(method + ("\n" + text(set)));
    ASSERT_EQ(set.size(), places.size());
    for (const Vec3& place : places)
      EXPECT_TRUE(std::any_of(set.begin(), set.end(), [&](const Lmd& lmd) {
        return (lmd.point_fixed - place).norm() < 1e-12;
      })) << place.transpose();
  }
}

/// Two slopes that meet in a horizontal ridge at their lowest line, for a mesh that is above.
TriangleMesh ridge_from_above(const Vec3& from, const Vec3& to) {
  const Vec3 across = 0.5 * (to - from).cross(Vec3::UnitZ()).normalized(), up(0.0, 0.0, 0.2);
  TriangleMesh mesh;
  mesh.vertices = {from, to, from + across + up, to + across + up, from - across + up, to - across + up};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}};
  return mesh;
}

// Separate sets of minimisers are separate LMDs, even if their triangles share corners on both
// meshes. The contacts are known by construction.

TEST(FlatScenes, OverlapsOfManyPieces) {
  // Rings and gears on each other: the pieces of one overlap come in any order, and all must count.
  const TriangleMesh ring =
      make_sleeve(circle_outline(0.1), circle_outline(0.06), {.height = 0.05, .around = 24});
  const Outline teeth = gear_outline(10, 0.02, 0.0004);
  const TriangleMesh gear = make_sleeve(teeth, circle_outline(0.04, teeth), {.height = 0.05, .around = 80});
  const TriangleMesh hexagon =
      make_sleeve(polygon_outline(6, 0.1), circle_outline(0.05), {.height = 0.05, .around = 24});
  std::mt19937_64 random(11);
  for (const auto& [moving, fixed] : {std::pair(ring, ring), {gear, gear}, {hexagon, ring}, {ring, gear}}) {
    FlatComparison pair(make_scene(moving, fixed, 0.02));
    for (int i = 0; i < 20; ++i) pair.check(turned_on_top(random, 0.06));
    EXPECT_GT(pair.found(), 15u);
  }
}

/// A prism's corners: so many that a comparison of all triangles would show.
constexpr int CORNERS = 48;

TriangleMesh disc() {
  return make_sleeve(circle_outline(0.1), nullptr, {.height = 0.05, .around = CORNERS});
}

TEST(FlatScenes, PartsAtRestHaveADirectionAndIntersectNothing) {
  const TriangleMesh ring =
      make_sleeve(circle_outline(0.1), circle_outline(0.06), {.height = 0.05, .around = 24});
  const TriangleMesh box = make_box({0.1, 0.1, 0.05}, 3);
  std::mt19937_64 random(12);
  for (const auto& [moving, fixed] : {std::pair(disc(), disc()), {box, box}, {ring, ring}, {disc(), ring}}) {
    const Scene scene = make_scene(moving, fixed, 0.02);
    FlatComparison pair(scene);
    for (int i = 0; i < 20; ++i) {
      // Borders that cross, then such as lie on each other.
      const Pose pose = i < 16 ? turned_on_top(random, 0.05)
                               : Pose{Vec3(i % 2 == 0 ? 0.0 : 0.02, i < 18 ? 0.0 : 0.02, 0.05),
                                      Eigen::Quaterniond::Identity()};
      pair.check(pose);
      LmdSet lmds = lmds_at(*make_method("certified", scene), pose);
      std::erase_if(lmds, [](const Lmd& lmd) { return lmd.distance > 1e-6; });  // beside, not below
      EXPECT_FALSE(lmds.empty()) << text(pose);
      for (const Lmd& lmd : lmds) {
        EXPECT_FALSE(lmd.intersecting) << text(pose) << text(lmds);
        EXPECT_NEAR((lmd.direction + Vec3::UnitZ()).norm(), 0.0, 1e-12) << text(pose) << text(lmds);
      }
    }
  }
}

TEST(FlatScenes, TrianglesOfFacesAtRestAreNotCompared) {
  const Scene scene = make_scene(disc(), disc(), 0.02);
  for (const double shift : {0.0, 1e-3, 0.05}) {
    LmdSet lmds;
    WorkCounters counters;
    make_method("certified", scene)
        ->search({Vec3(shift, 0.0, 0.05), Eigen::Quaterniond::Identity()}, lmds, counters);
    EXPECT_EQ(lmds.size(), 1u) << text(lmds);
    // The walls' alone; of the faces all CORNERS * CORNERS pairs touch.
    EXPECT_LT(counters[Certified::Counter::TRIANGLE_DISTANCES], 20u * CORNERS) << shift;
  }
}

TEST(FlatScenes, TrianglesOfWallsAtRestAreNotCompared) {
  // Of the box's walls a quarter of a thousand triangles are next to the plate's, either way round.
  const TriangleMesh box = make_box({0.1, 0.1, 0.05}, 4), plate = make_box({0.4, 0.4, 0.05}, 16);
  for (const bool box_moves : {true, false}) {
    const Scene scene = make_scene(box_moves ? box : plate, box_moves ? plate : box, 0.02);
    FlatComparison pair(scene);
    for (const double gap : {0.0, 1e-12, 1e-9}) {
      Pose pose{Vec3(0.01, 0.0, 0.05 + gap), Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3::UnitZ()))};
      if (!box_moves) pose = pose.inverse();
      pair.check(pose);
      LmdSet lmds;
      WorkCounters counters;
      make_method("certified", scene)->search(pose, lmds, counters);
      EXPECT_EQ(lmds.size(), 1u) << text(lmds);
      EXPECT_LT(counters[Certified::Counter::TRIANGLE_DISTANCES], 20u) << gap;
    }
  }
}

TEST(FlatScenes, AWallThatLeavesItsEdgeAlongTheFloorIsCompared) {
  // The edge is in the floor by less than rounding; the thin triangle beside its end comes out of
  // it farther on than the edge's contact tells of.
  for (const double rise : {1e-9, 1e-8, 1e-7}) {
    TriangleMesh wall;
    wall.vertices = {{0.0, 0.0, -3e-15}, {0.0, 0.1, -3e-15},      {0.0, 0.1, 0.1},
                     {0.0, -0.1, 0.1},   {0.0, -0.1, 2.0 * rise}, {0.0, -0.1, rise}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    const TriangleMesh floor = make_box({0.3, 0.3, 0.1}, 3);
    const Pose pose{Vec3(0.01, 0.0, 0.05), Eigen::Quaterniond::Identity()};
    for (const bool wall_moves : {true, false}) {
      FlatComparison pair(make_scene(wall_moves ? wall : floor, wall_moves ? floor : wall, 0.02));
      pair.check(wall_moves ? pose : pose.inverse());
      EXPECT_EQ(pair.found(), 2u) << rise;
    }
  }
}

/// A tetrahedron with its apex at the origin and its body along `axis`.
TriangleMesh make_spike(const Vec3& axis) {
  const Vec3 across = axis.unitOrthogonal(), other = axis.cross(across);
  TriangleMesh spike;
  spike.vertices = {Vec3::Zero(), axis + 0.1 * across, axis - 0.1 * across + 0.1 * other,
                    axis - 0.1 * across - 0.1 * other};
  spike.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  return spike;
}

/// Rounding may turn a needle of a region over: at the first edge of a chain, whose outer side and
/// wings are its regions'.
TEST(FlatScenes, ANeedleTurnedOverAtAConvexChainChangesNoSet) {
  const TriangleMesh spike = make_spike(Vec3(0.0, -0.3, 0.954).normalized());
  for (const double y : {-5e-14, -3e-14, 3e-14, 5e-14}) {
    TriangleMesh box;
    box.vertices = {{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.01, y, 0.0},   {1.0, 0.0, 0.0},  {1.0, 1.0, 0.0},
                    {0.0, 1.0, 0.0}, {0.0, 0.0, -0.5}, {1.0, 0.0, -0.5}, {1.0, 1.0, -0.5}, {0.0, 1.0, -0.5}};
    box.triangles = {{0, 1, 2}, {0, 2, 5}, {2, 4, 5}, {2, 1, 4}, {1, 3, 4}, {1, 0, 6}, {1, 6, 7}, {3, 1, 7},
                     {4, 3, 7}, {4, 7, 8}, {5, 4, 8}, {5, 8, 9}, {0, 5, 9}, {0, 9, 6}, {6, 8, 7}, {6, 9, 8}};
    FlatComparison pair(make_scene(spike, box, 0.3));
    pair.check({Vec3(0.6, -0.03, 0.0954), Eigen::Quaterniond::Identity()});
    EXPECT_EQ(pair.found(), 1u) << y;
  }
}

TEST(FlatScenes, ANeedleTurnedOverAtAReflexChainChangesNoSet) {
  // A plate on a wedge below its edge from 2 to 4; the needle 2 4 3 belongs to the plate.
  TriangleMesh plate;
  plate.vertices = {{-1.0, -1.0, 0.0},  {0.0, -1.0, 0.0},  {0.0, 0.0, 1e-14},  {0.005, -3e-15, -1e-14},
                    {0.01, 0.0, 1e-14}, {0.01, 1.0, 0.0},  {-1.0, 1.0, 0.0},   {-1.0, -1.0, -0.3},
                    {0.0, -1.0, -0.3},  {0.0, -0.4, -0.3}, {0.01, -0.4, -0.3}, {0.01, 1.0, -0.3},
                    {-1.0, 1.0, -0.3}};
  plate.triangles = {{2, 4, 3},  {0, 1, 2},   {0, 2, 6},   {2, 3, 6},   {3, 4, 5},  {3, 5, 6},
                     {1, 0, 7},  {1, 7, 8},   {2, 1, 8},   {2, 8, 9},   {4, 2, 9},  {4, 9, 10},
                     {5, 4, 10}, {5, 10, 11}, {6, 5, 11},  {6, 11, 12}, {0, 6, 12}, {0, 12, 7},
                     {7, 9, 8},  {7, 12, 9},  {9, 12, 11}, {9, 11, 10}};
  FlatComparison pair(make_scene(make_spike(Vec3(0.0, 1.0, 1.0).normalized()), plate, 0.2));
  pair.check({Vec3(0.0051, 0.1, 0.1), Eigen::Quaterniond::Identity()});
  EXPECT_EQ(pair.found(), 1u) << "the face below the apex, and not the edge";
}

TEST(FlatScenes, AContactOfTheFaceStandsForTheWallsBesideIt) {
  // Rings, whose edges' contacts are covered by that of their faces.
  const TriangleMesh ring =
      make_sleeve(circle_outline(0.1), circle_outline(0.06), {.height = 0.05, .around = 24});
  const Scene scene = make_scene(ring, ring, 0.02);
  LmdSet lmds;
  WorkCounters counters;
  make_method("certified", scene)
      ->search({Vec3(0.0, 0.0, 0.05), Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Vec3::UnitZ()))}, lmds,
               counters);
  EXPECT_EQ(lmds.size(), 1u) << text(lmds);
  EXPECT_LT(counters[Certified::Counter::TRIANGLE_DISTANCES], 150u);
}

TEST(FlatScenes, FacesAtRestOfPartsThatIntersectBesideAreCompared) {
  // On the floor of the notch, and in its wall by more than rounding or less.
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 3), make_l_block(0.4), 0.02));
  for (const double depth : {1e-3, 1e-6, 1e-9, 0.0, -1e-9, -1e-3})
    for (const double y : {0.0, 0.03, 0.17, 0.2})
      boxes.check({Vec3(0.05 - depth, y, 0.05), Eigen::Quaterniond::Identity()});
  EXPECT_GT(boxes.found(), 24u);
}

TEST(FlatScenes, FloorAndWallAtOneDistanceAreTwoContacts) {
  // Floor and wall meet on the box's edge.
  FlatComparison corner(make_scene(make_l_block(1.0), make_box({0.2, 0.2, 0.2}, 2), 0.02));
  corner.check(testing::moved(-0.11, 0.0, -0.11));
  EXPECT_EQ(corner.found(), 2u);
}

TEST(FlatScenes, ACornerHasAContactAnywhereOverALongFace) {
  // Above the box of the face's region, which is longer one way or the other.
  const Eigen::Quaterniond corner_down = Eigen::Quaterniond::FromTwoVectors(Vec3::Ones(), -Vec3::UnitZ());
  const double height = 0.05 + 0.01 * std::numbers::sqrt3 + 0.01;
  for (const Vec3& along : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const Vec3 size = 0.9 * along + Vec3::Constant(0.1);
    FlatComparison corner(make_scene(make_box({0.02, 0.02, 0.02}, 1), make_box(size, 2), 0.02));
    for (int i = -4; i <= 4; ++i) corner.check({0.11 * i * along + Vec3(0.013, 0.017, height), corner_down});
    EXPECT_EQ(corner.found(), 9u);
  }
}

TEST(FlatScenes, RoundedBoxesAtGapsDownToTouch) {
  std::mt19937_64 random(12);
  const auto file = [](TriangleMesh mesh, std::uint64_t seed) {
    mesh = testing::rounded_to_floats(testing::turned(std::move(mesh), seed));
    flatten(mesh);
    return mesh;
  };
  FlatComparison boxes(
      make_scene(file(make_box({1.0, 1.0, 1.0}, 2), 1), file(make_box({3.0, 3.0, 1.0}, 2), 2), 0.1));
  for (int i = 0; i < 60; ++i) {
    Pose on_top = turned_on_top(random, 1.0 + std::pow(10.0, -7.5 + 3.0 * uniform(random)));
    boxes.check(testing::pose_of_seed(2) * on_top * testing::pose_of_seed(1).inverse());
  }
  EXPECT_GT(boxes.found(), 50u);
}

TEST(FlatScenes, OverlapsThatAreApartAreTwoContactsHoweverLargeTheTriangles) {
  const Scene scene = make_scene(make_l_block(0.1), make_l_block(0.13), 0.02);
  const Pose pose{Vec3(0.068008165683898031, -0.116, 0.00074457514592900925),
                  Eigen::Quaterniond(0.93280356198851988, 0.0, -0.36038523102581421, 0.0)};
  for (const char* method : {"exhaustive", "certified"}) {
    const LmdSet set = lmds_at(*make_method(method, scene), pose);
    ASSERT_EQ(set.size(), 2u) << method;
    EXPECT_GT((set[0].point_fixed - set[1].point_fixed).norm(), 0.01) << method;
  }
}

TEST(FlatScenes, ARidgeOverTheNotchOfAnLHasAContactOnEitherArm) {
  // The L's face at y = -1: arms of width 1, a notch where x > 0 and z > 0. All its triangles meet
  // in the notch's corner. The ridge is 0.01 in front of it, along x + z = 0.5.
  TriangleMesh ridge = ridge_from_above({1.5, -1.0, 0.0}, {-1.0, 1.5, 0.0});
  for (Vec3& p : ridge.vertices) p = Vec3(p.x(), -1.01 - p.z(), p.y());
  const Scene scene = make_scene(ridge, make_l_block(2.0), 0.02);
  const auto middle = [](double from, double to) {
    return Vec3(0.5 * (from + to), -1.0, 0.5 - 0.5 * (from + to));
  };
  expect_contacts_at(scene, {}, {middle(0.5, 1.0), middle(-0.5, 0.0)});
}

TEST(FlatScenes, ARidgeOverALineBetweenTrianglesCountsOnce) {
  // Four squares of two triangles: the ridge runs along the first diagonal, across the last.
  TriangleMesh squares;
  for (const double y : {0.0, 1.0, 2.0})
    for (const double x : {0.0, 1.0, 2.0}) squares.vertices.emplace_back(x, y, 0.0);
  squares.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4},
                       {3, 4, 7}, {3, 7, 6}, {4, 5, 7}, {5, 8, 7}};
  // Slopes on both sides, or a sheet on its edge: seen along the contact, a sheet has no area.
  TriangleMesh sheet;
  sheet.vertices = {{0.25, 0.25, 0.01}, {1.75, 1.75, 0.01}, {0.25, 0.25, 0.5}, {1.75, 1.75, 0.5}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}};
  for (const TriangleMesh& above : {ridge_from_above(sheet.vertices[0], sheet.vertices[1]), sheet}) {
    for (const double angle : {0.0, 0.3, 1.1, 2.3}) {
      const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
      TriangleMesh turned_above = above, turned_squares = squares;
      for (TriangleMesh* mesh : {&turned_above, &turned_squares})
        for (Vec3& p : mesh->vertices) p = turn * p;
      SCOPED_TRACE(angle);
      expect_contacts_at(make_scene(turned_above, turned_squares, 0.02), {}, {turn * Vec3(1.0, 1.0, 0.0)});
      expect_contacts_at(make_scene(turned_squares, turned_above, 0.02), {}, {turn * Vec3(1.0, 1.0, 0.01)});
    }
  }
}

TEST(FlatScenes, ARidgeAcrossTwoRidgesThatMeetHasTwoContacts) {
  // Two ridges at one height meet at vertex 0, with slopes on both sides; a third crosses both.
  TriangleMesh corner;
  corner.vertices = {{0, 0, 0},     {1, 0, 0},      {0, 1, 0},    {1, 1, -0.5},
                     {1, -1, -0.5}, {-1, -1, -0.5}, {-1, 1, -0.5}};
  corner.triangles = {{0, 1, 3}, {0, 3, 2}, {0, 5, 4}, {0, 4, 1}, {0, 2, 6}, {0, 6, 5}};
  const Scene scene = make_scene(ridge_from_above({1.5, -1.0, 0.01}, {-1.0, 1.5, 0.01}), corner, 0.02);
  expect_contacts_at(scene, {}, {{0.5, 0.0, 0.0}, {0.0, 0.5, 0.0}});
}

/// Two squares side by side; the right one has a vertex in the common side. A triangle without area
/// closes the gap there, as design programs do. No region extends across such a triangle.
TriangleMesh squares_with_a_seam() {
  TriangleMesh mesh;
  mesh.vertices = {{-0.2, -0.2, 0}, {0, -0.2, 0},  {0, 0.2, 0}, {-0.2, 0.2, 0},
                   {0.2, -0.2, 0},  {0.2, 0.2, 0}, {0, 0.05, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 6}, {6, 4, 5}, {6, 5, 2}, {2, 1, 6}};
  return mesh;
}

TEST(FlatScenes, AFaceInSeveralRegionsIsOneContact) {
  // A box stands on the seam; the middle of the contact is below the box's middle.
  std::mt19937_64 random(8);
  std::size_t split = 0;
  for (int i = 0; i < 60; ++i) {
    const int kind = i % 3;  // as made, turned, rounded
    TriangleMesh seam = squares_with_a_seam(), box = make_box({0.1, 0.08, 0.1}, 2);
    const Pose X_FD = kind == 0 ? Pose{} : testing::pose_of_seed(random());
    const Pose X_MD = kind == 0 ? Pose{} : testing::pose_of_seed(random());
    seam = testing::placed(std::move(seam), X_FD);
    box = testing::placed(std::move(box), X_MD);
    if (kind == 2) {
      for (TriangleMesh* mesh : {&seam, &box}) {
        *mesh = testing::rounded_to_floats(std::move(*mesh));
        flatten(*mesh);
      }
    }
    const Scene scene = make_scene(box, seam, 0.02);
    split += scene.fixed[0]->prepared<FlatRegions>().region_count() > 1;
    Pose X_DB;
    X_DB.translation = Vec3(0.03 * (uniform(random) - 0.5), 0.2 * (uniform(random) - 0.5), 0.06);
    X_DB.rotation = Eigen::AngleAxisd(2.0 * std::numbers::pi * uniform(random), Vec3::UnitZ());
    const Pose pose = X_FD * X_DB * X_MD.inverse();
    const Vec3 middle = RigidTransform(X_FD).point({X_DB.translation.x(), X_DB.translation.y(), 0.0});
    for (const char* method : {"exhaustive", "certified"}) {
      const LmdSet set = lmds_at(*make_method(method, scene), pose);
      SCOPED_TRACE(fmt::format("{} kind {}, {}\n{}", method, kind, text(pose), text(set)));
      ASSERT_EQ(set.size(), 1u);
      EXPECT_LT((set[0].point_fixed - middle).norm(), kind == 2 ? 1e-6 : 1e-12);
    }
  }
  EXPECT_GT(split, 30u);
}

TEST(FlatScenes, AFaceTiltedByLessThanATolerancesIsStillOneContactAPlace) {
  // The minimum of each triangle pair is at another corner, but all belong to one LMD.
  std::mt19937_64 random(6);
  const Scene boxes = make_scene(make_box({0.1, 0.1, 0.1}, 3), make_box({0.3, 0.3, 0.1}, 4), 0.02);
  const Scene feet = make_scene(make_two_boxes({0.03, 0.1, 0.1}, 0.04), make_box({0.3, 0.3, 0.1}, 1), 0.02);
  for (int i = 0; i < 30; ++i) {
    Pose pose = turned_on_top(random, 0.105);
    pose.translation *= 0.5;
    pose.translation.z() = 0.105;
    const double tilt = std::pow(10.0, -14.0 + 3.5 * uniform(random));
    pose.rotation = Eigen::AngleAxisd(tilt, random_direction(random)) * pose.rotation;
    for (const char* method : {"exhaustive", "certified"}) {
      const LmdSet of_box = lmds_at(*make_method(method, boxes), pose);
      EXPECT_EQ(of_box.size(), 1u) << method << " " << text(pose) << "\n" << text(of_box);
      const LmdSet of_feet = lmds_at(*make_method(method, feet), pose);
      EXPECT_EQ(of_feet.size(), 2u) << method << " " << text(pose) << "\n" << text(of_feet);
    }
  }
}

TEST(FlatScenes, EdgesAreParallelWhileTheyDriftByLessThanTheyAreKnownTo) {
  // A ridge over a ridge, turned beside the middle of their common part: they touch where they
  // cross, if they do. They are known to 1e-10 m and share 0.07 m.
  const Scene scene = make_scene(make_wedge(0.05, 0.1, 0.05), make_wedge(0.05, 0.1, 0.05), 0.01);
  for (const auto& [turn, place] : {std::pair(1e-9, 0.015), std::pair(2.9e-9, 0.03), std::pair(1e-4, 0.03)}) {
    Pose pose;
    pose.translation = {0.0, 0.03, 0.051};
    pose.rotation =
        Eigen::AngleAxisd(turn, Vec3::UnitZ()) * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY());
    for (const char* method : {"exhaustive", "certified"}) {
      const LmdSet set = lmds_at(*make_method(method, scene), pose);
      ASSERT_EQ(set.size(), 1u) << method << " " << turn << "\n" << text(set);
      EXPECT_NEAR(set[0].point_fixed.y(), place, 1e-6) << method << " " << turn;
    }
  }
}

/// Cases that are left to triangles: ridges between the touch distance and twice it, and a ridge
/// over two ridges in one line between other faces.
TEST(FlatScenes, EdgesAlongEdgesByTheirTriangles) {
  std::mt19937_64 random(13);
  const TriangleMesh ridge = make_wedge(0.05, 0.1, 0.05);
  const auto over = [&](double height) {
    return Pose{Vec3(0.0, 0.06 * (uniform(random) - 0.5), 0.025 + height),
                Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()))};
  };
  FlatComparison near(make_scene(ridge, ridge, 0.01));
  for (int i = 0; i < 60; ++i) near.check(over(0.025 + 1e-11 * std::pow(10.0, 2.0 * uniform(random))));
  EXPECT_GE(near.found(), 60u);
  TriangleMesh roof;
  roof.vertices = {{0, -0.05, 0.05}, {0, 0, 0.05},      {0, 0.05, 0.05}, {-0.025, -0.05, 0},
                   {-0.025, 0, 0},   {0.025, -0.05, 0}, {0.025, 0, 0},   {-0.04, 0, 0},
                   {-0.04, 0.05, 0}, {0.04, 0, 0},      {0.04, 0.05, 0}};
  roof.triangles = {{0, 1, 4}, {0, 4, 3}, {0, 5, 6}, {0, 6, 1}, {1, 2, 8}, {1, 8, 7}, {1, 9, 10}, {1, 10, 2}};
  FlatComparison roofs(make_scene(ridge, roof, 0.01));
  for (int i = 0; i < 20; ++i) roofs.check(over(0.05 + 0.005 * uniform(random)));
  EXPECT_GE(roofs.found(), 20u);
}

TEST(FlatScenes, EdgesOnFacesAndAlongEdges) {
  std::mt19937_64 random(3);
  FlatComparison wedge(make_scene(make_wedge(0.05, 0.1, 0.05), make_box({0.2, 0.2, 0.1}, 4), 0.03));
  for (int i = 0; i < 40; ++i) {
    Pose pose = turned_on_top(random, 0.085);
    pose.rotation = pose.rotation * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX());
    wedge.check(pose);
  }
  EXPECT_GT(wedge.found(), 30u);
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 3), make_box({0.1, 0.1, 0.1}, 2), 0.05));
  for (int i = 0; i < 20; ++i)
    boxes.check({Vec3(0.11 + 0.01 * uniform(random), 0.11, 0.16 * (uniform(random) - 0.5)),
                 Eigen::Quaterniond::Identity()});
  EXPECT_GT(boxes.found(), 15u);
}

TEST(FlatScenes, TiltedBoxesAtAnyAngle) {
  std::mt19937_64 random(4);
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 3), make_box({0.3, 0.3, 0.1}, 4), 0.03));
  for (int i = 0; i < 60; ++i) {
    Pose pose = turned_on_top(random, 0.115);
    const double tilt = std::pow(10.0, -14.0 + 13.0 * uniform(random));
    pose.rotation = Eigen::AngleAxisd(tilt, random_direction(random)) * pose.rotation;
    boxes.check(pose);
  }
  for (int i = 0; i < 60; ++i) {
    Pose pose = turned_on_top(random, 0.05 + 0.12 * uniform(random));
    pose.rotation = testing::random_rotation(random);
    boxes.check(pose);
  }
  EXPECT_GT(boxes.found(), 60u);
}

/// A plate over its copy, walls over walls included, for any number of triangles.
TEST(FlatScenes, WorkDoesNotGrowWithTheTriangles) {
  const auto work_of = [](int cells) {
    const TriangleMesh plate = make_box({0.1, 0.1, 0.01}, {cells, cells, 1});
    const auto method = make_method("certified", make_scene(plate, plate, 0.001));
    LmdSet set;
    WorkCounters counters;
    std::mt19937_64 random(5);
    for (int i = 0; i < 20; ++i) {
      Pose pose = turned_on_top(random, 0.0101);
      pose.translation.head<2>() *= 0.5;
      method->search(pose, set, counters);
      EXPECT_EQ(set.size(), 1u) << cells << " " << text(pose);
    }
    return std::tuple(counters[Certified::Counter::NODE_PAIRS], counters[Certified::Counter::LEAF_PAIRS],
                      counters[Certified::Counter::TRIANGLE_DISTANCES]);
  };
  EXPECT_EQ(work_of(4), work_of(64));
}

/// Of two gears in mesh a few teeth are near each other, however many their faces' outlines have:
/// work may grow with the teeth, not with their square (all borders asked: a hundredfold).
TEST(FlatScenes, WorkGrowsAtMostWithTheTeethOfGears) {
  const auto leaf_pairs_of = [](int teeth) {
    const double radius = 0.5 * teeth;
    const TriangleMesh gear =
        make_sleeve(gear_outline(teeth, 1.0, 0.04), circle_outline(0.5 * radius), {2.0, 16 * teeth, 1, 1});
    const auto method = make_method("certified", make_scene(gear, gear, 0.05));
    LmdSet set;
    WorkCounters counters;
    for (int i = 0; i < 20; ++i) {
      // A tooth in a gap, on one flank, rolling through a third of a tooth.
      const double turn = (i / 60.0) * 2.0 * std::numbers::pi / teeth;
      const double own = std::numbers::pi * (1.0 + 1.0 / teeth) + turn + 0.03 / radius;
      const Eigen::Quaterniond along(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
      method->search({along * Vec3(2.0 * radius, 0.0, 0.0),
                      along * Eigen::Quaterniond(Eigen::AngleAxisd(own, Vec3::UnitZ()))},
                     set, counters);
      EXPECT_GE(set.size(), 1u) << teeth << " " << i;
    }
    return counters[Certified::Counter::LEAF_PAIRS];
  };
  const auto of_few = leaf_pairs_of(12), of_many = leaf_pairs_of(96);
  EXPECT_LE(of_many, 8 * of_few);
}

/// A box behind a strip, above both borders and above the face, which looks away.
TEST(FlatScenes, BordersOfASheetThatTurnsAway) {
  TriangleMesh strip;
  strip.vertices = {{-0.01, -0.1, 0.0}, {0.01, -0.1, 0.0}, {0.01, 0.1, 0.0}, {-0.01, 0.1, 0.0}};
  strip.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::mt19937_64 random(14);
  FlatComparison behind(make_scene(make_box({0.05, 0.05, 0.05}, 2), strip, 0.01));
  for (int i = 0; i < 20; ++i) {
    Pose pose = turned_on_top(random, -0.026 - 0.005 * uniform(random));
    pose.translation.head<2>() *= 0.1;
    behind.check(pose);
  }
  EXPECT_GE(behind.found(), 20u);
}

/// Open squares in the plane z = 0: no walls at their borders would be asked as well.
FlatComparison two_squares() {
  const TriangleMesh square = testing::sheet_of({"#"}, 1.0);
  return FlatComparison(make_scene(square, square, 0.01));
}
const Eigen::Quaterniond TURNED_OVER(0.0, 1.0, 0.0, 0.0);

TEST(FlatScenes, SheetsInOnePlaneMeetAlongTheirBorders) {
  FlatComparison sheets = two_squares();
  for (const double x : {-1.0, -0.5, 0.0, 0.25, 1.0})
    for (const double y : {-1.0, 0.0, 0.5, 1.0})
      for (const double gap : {0.0, 1e-15, 0.005}) sheets.check({Vec3(x, y, gap), TURNED_OVER});
  EXPECT_EQ(sheets.found(), 60u);
}

TEST(FlatScenes, ACornerOfASheetMeetsABorder) {
  // Of either sheet.
  const Eigen::Quaterniond turned = TURNED_OVER * Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitZ());
  FlatComparison sheets = two_squares();
  for (const double gap : {0.0, 1e-15, 1e-12, 0.005})
    for (const double overlap : {-1e-15, 0.0, 1e-15, 1e-13}) {
      const Pose corner{Vec3(0.5 + 0.5 * std::numbers::sqrt2 - overlap, 0.1, gap), turned};
      sheets.check(corner);
      sheets.check(corner.inverse());
    }
  EXPECT_EQ(sheets.found(), 32u);
}

/// From rounding to beyond the tolerance: faces over faces, edge over face, edges along edges.
TEST(FlatScenes, TiltsFromRoundingToBeyondTheTolerance) {
  std::mt19937_64 random(12);
  const TriangleMesh table = make_box({0.3, 0.3, 0.1}, 4);
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 3), table, 0.03));
  FlatComparison feet(make_scene(make_two_boxes({0.03, 0.1, 0.1}, 0.04), table, 0.03));
  FlatComparison wedge(make_scene(make_wedge(0.05, 0.1, 0.05), table, 0.03));
  FlatComparison wedges(make_scene(make_wedge(0.05, 0.1, 0.05), make_wedge(0.05, 0.1, 0.05), 0.02));
  FlatComparison edges(make_scene(make_box({0.1, 0.1, 0.1}, 4), make_box({0.1, 0.1, 0.1}, 3), 0.02));
  const auto tilted = [&](Pose pose) {
    const double tilt = std::pow(10.0, -11.0 + 4.0 * uniform(random));
    pose.rotation = Eigen::AngleAxisd(tilt, random_direction(random)) * pose.rotation;
    return pose;
  };
  const Eigen::AngleAxisd over(std::numbers::pi, Vec3::UnitX());
  for (int i = 0; i < tilted_poses(); ++i) {
    const double height = 0.02 * std::pow(10.0, -3.0 * uniform(random));
    boxes.check(tilted(turned_on_top(random, 0.1 + height)));
    feet.check(tilted(turned_on_top(random, 0.1 + height)));
    Pose pose = turned_on_top(random, 0.075 + height);
    pose.rotation = pose.rotation * over;
    wedge.check(tilted(pose));
    wedges.check(tilted({Vec3(2e-4 * (uniform(random) - 0.5), 0.1 * (uniform(random) - 0.5), 0.05 + height),
                         Eigen::Quaterniond(over)}));
    // A direction at the border of the fixed edge's cone: along the edge it gets over a face.
    const double off = (uniform(random) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, -8.0 + 4.0 * uniform(random));
    const double gap = std::pow(10.0, -6.0 + 3.0 * uniform(random));
    Pose aside = tilted(
        {Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(0.25 * std::numbers::pi - 0.3, Vec3::UnitY()))});
    aside.translation =
        Vec3(0.05 + gap * std::sin(off), 0.08 * (uniform(random) - 0.5), 0.05 + gap * std::cos(off)) -
        aside.rotation * Vec3(0.05, 0.0, -0.05);
    edges.check(aside);
  }
  for (const FlatComparison* scene : {&boxes, &feet, &wedge, &wedges, &edges})
    EXPECT_GE(scene->found(), static_cast<std::size_t>(tilted_poses()) / 2);
}

/// Of meshes that are known to a millionth of their size, an edge has one contact with both slopes
/// of so shallow a valley, which its lowest edge joins, though that bends inwards.
TEST(FlatScenes, AnEdgeAlongAValleyShallowerThanTheTilt) {
  std::mt19937_64 random(15);
  TriangleMesh ridge = ridge_from_above({-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0});
  ridge.planar_tolerance = 1e-6;
  std::size_t at_the_edge = 0;
  for (int i = 0; i < tilted_poses(); ++i) {
    const double rise = std::pow(10.0, -7.0 + 4.0 * uniform(random));
    TriangleMesh valley;
    valley.vertices = {{-1.0, -1.0, rise}, {1.0, -1.0, rise}, {-1.0, 0.0, 0.0},
                       {1.0, 0.0, 0.0},    {-1.0, 1.0, rise}, {1.0, 1.0, rise}};
    valley.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
    // Partly single triangles.
    if (i % 3 == 0) valley.triangles = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
    valley.planar_tolerance = 1e-6;
    FlatComparison both(make_scene(ridge, valley, 0.2));
    const Vec3 along(1.0, i % 2 == 0 ? 0.0 : 5e-5 * (uniform(random) - 0.5), 0.0);
    both.check({Vec3(0.2 * uniform(random), 2e-6 * (uniform(random) - 0.5), 0.2 * uniform(random)),
                Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), along)});
    if (both.found() == 1) ++at_the_edge;
  }
  EXPECT_GE(at_the_edge, static_cast<std::size_t>(tilted_poses()) / 4);
  EXPECT_LT(at_the_edge, static_cast<std::size_t>(tilted_poses()));
}

/// Nearly flat sheets of a few triangles, in steps of one height, known to a tolerance. Diagonals
/// run one way: between those of `sheet_of`, which alternate, fewer planted defects are told.
TriangleMesh shallow_sheet(std::mt19937_64& random, double height, double tolerance, bool faces_up) {
  constexpr int CELLS = 2;
  TriangleMesh sheet;
  for (int j = 0; j <= CELLS; ++j)
    for (int i = 0; i <= CELLS; ++i)
      sheet.vertices.emplace_back(i - 0.5 * CELLS, j - 0.5 * CELLS,
                                  height * static_cast<double>(random() % 3));
  for (std::int32_t j = 0; j < CELLS; ++j)
    for (std::int32_t i = 0; i < CELLS; ++i) {
      const std::int32_t k = j * (CELLS + 1) + i, above = k + CELLS + 1;
      sheet.triangles.push_back({k, k + 1, above});
      sheet.triangles.push_back({k + 1, above + 1, above});
    }
  if (!faces_up)
    for (auto& triangle : sheet.triangles) std::swap(triangle[0], triangle[1]);
  sheet.planar_tolerance = tolerance;
  return sheet;
}

/// Bends from rounding to beyond the tilt, of meshes that are known to any tolerance.
TEST(FlatScenes, SheetsWithShallowBends) {
  std::mt19937_64 random(16);
  std::size_t found = 0;
  for (int i = 0; i < tilted_poses(); ++i) {
    const auto any = [&](double least, double largest) {
      return std::pow(10.0, least + (largest - least) * uniform(random));
    };
    const double height = any(-10.0, -3.0), tolerance = i % 4 == 0 ? 0.0 : any(-9.0, -5.5);
    const TriangleMesh below = shallow_sheet(random, height, tolerance, true);
    const TriangleMesh above = i % 3 == 0   ? shallow_sheet(random, any(-10.0, -3.0), tolerance, false)
                               : i % 3 == 1 ? ridge_from_above({-0.6, 0.0, 0.0}, {0.6, 0.0, 0.0})
                                            : translated(make_box({0.7, 0.7, 0.4}, 1), {0.0, 0.0, 0.2});
    FlatComparison both(make_scene(above, below, 0.2));
    const double angle = std::array{0.0, 0.25, 0.5, uniform(random)}[random() % 4] * std::numbers::pi;
    const Vec3 place(std::array{0.0, 0.5, uniform(random)}[random() % 3],
                     std::array{0.0, 0.5, uniform(random)}[random() % 3], 2.0 * height + any(-9.0, -0.8));
    both.check({place, Eigen::AngleAxisd(any(-10.0, -4.0), random_direction(random)) *
                           Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()))});
    found += both.found();
  }
  EXPECT_GE(found, static_cast<std::size_t>(tilted_poses()) / 2);
}

/// Of triangles of some hundred roundings that cross, corners still have a contact.
TEST(FlatScenes, CornersOfCrossingTrianglesAsSmallAsRounding) {
  constexpr double UNIT = 1.2789769243681803e-12, RISE = 5.1159076974727215e-14;
  TriangleMesh a, b;
  a.vertices = {{0.0, 0.0, 0.0},   {2.0 * UNIT, -UNIT, RISE}, {2.0 * UNIT, UNIT, RISE},
                {-1.0, -1.0, 0.9}, {1.0, -1.0, 0.9},          {0.0, 1.0, 0.9}};
  b.vertices = {{0.0, 0.0, 0.0},
                {2.0 * UNIT, -0.9 * UNIT, -RISE},
                {2.0 * UNIT, 1.1 * UNIT, -RISE},
                {-1.0, -1.0, -0.9},
                {1.0, -1.0, -0.9},
                {0.0, 1.0, -0.9}};
  a.triangles = {{0, 1, 2}, {3, 4, 5}};
  b.triangles = {{0, 1, 2}, {3, 5, 4}};
  FlatComparison both(make_scene(a, b, 1e-3));
  both.check({Vec3(0.0, 0.0, -RISE), Eigen::Quaterniond::Identity()});
  EXPECT_GE(both.found(), 1u);
}

/// Nearly one triangle many times, with one tip, and a triangle far away that gives the size.
TriangleMesh small_fan(double rise, std::mt19937_64& random) {
  constexpr double SIZE = 1e-7;
  const double far_away = std::copysign(0.9, rise);
  TriangleMesh fan;
  fan.vertices = {{0.0, 0.0, 0.0}, {-1.0, -1.0, far_away}, {1.0, -1.0, far_away}, {0.0, 1.0, far_away}};
  fan.triangles = {rise > 0.0 ? std::array<std::int32_t, 3>{1, 2, 3} : std::array<std::int32_t, 3>{1, 3, 2}};
  for (std::int32_t k = 0; k < 20; ++k) {
    const double z = SIZE * rise * (1.0 + 0.1 * uniform(random));
    fan.vertices.emplace_back(SIZE, -SIZE * (0.45 + 0.1 * uniform(random)), z);
    fan.vertices.emplace_back(SIZE, SIZE * (0.5 + 0.05 * uniform(random)), z);
    fan.triangles.push_back({0, 2 * k + 4, 2 * k + 5});
  }
  return fan;
}

/// Corners of more than 64 wings together keep the direction that they have, at a gap of rounding.
TEST(FlatScenes, TipsOfManyCrossingTriangles) {
  std::mt19937_64 random(17);
  std::size_t found = 0;
  for (int i = 0; i < 20; ++i) {
    const TriangleMesh above = small_fan(0.0145, random), below = small_fan(-0.0145, random);
    FlatComparison both(make_scene(above, below, 1e-3));
    both.check({Vec3(0.0, 0.0, -2e-12 * (0.5 + uniform(random))), Eigen::Quaterniond::Identity()});
    found += both.found();
  }
  EXPECT_GT(found, 20u) << "tips, beside what intersects";
}

/// Nearly touching, where rounding lets the truth accept a tilt that is clear at larger gaps.
TEST(FlatScenes, TiltedBoxesThatNearlyTouch) {
  std::mt19937_64 random(9);
  const TriangleMesh box = make_box({0.1, 0.1, 0.1}, 3);
  FlatComparison boxes(make_scene(box, make_box({0.3, 0.3, 0.1}, 4), 0.03));
  for (int i = 0; i < tilted_poses(150); ++i) {
    Pose pose = turned_on_top(random, 0.0);
    const double tilt = std::pow(10.0, -12.0 + 10.0 * uniform(random));
    pose.rotation = Eigen::AngleAxisd(tilt, random_direction(random)) * pose.rotation;
    double lowest = 1.0;
    for (const Vec3& vertex : box.vertices) lowest = std::min(lowest, (pose.rotation * vertex).z());
    pose.translation.z() = 0.05 - lowest + std::pow(10.0, -16.0 + 10.0 * uniform(random));
    boxes.check(pose);
  }
  EXPECT_GT(boxes.found(), 100u);
}

/// Two faces that overlap in two places, one within the touch distance, the other perhaps not.
TEST(FlatScenes, TiltedBlocksThatNearlyTouchInOneOfTwoPlaces) {
  std::mt19937_64 random(10);
  const TriangleMesh block = make_l_block(0.1);
  FlatComparison blocks(make_scene(block, make_l_block(0.13), 0.02));
  const Eigen::Quaterniond turn(0.93280356198851988, 0.0, -0.36038523102581421, 0.0);
  for (int i = 0; i < tilted_poses(150); ++i) {
    const double tilt = std::pow(10.0, -11.0 + 5.0 * uniform(random));
    Vec3 axis = random_direction(random);
    axis.y() = 0.0;
    Pose pose{Vec3(0.068, 0.0, 0.0007), Eigen::AngleAxisd(tilt, axis.normalized()) * turn};
    double highest = -1.0;
    for (const Vec3& vertex : block.vertices) highest = std::max(highest, (pose.rotation * vertex).y());
    pose.translation.y() =
        -0.065 - highest + tilt * 0.1 * uniform(random) - std::pow(10.0, -13.0 + 5.0 * uniform(random));
    blocks.check(pose);
  }
  EXPECT_GT(blocks.found(), 150u);
}

TEST(FlatScenes, BoxesThatRockAndSlide) {
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 3), make_box({0.3, 0.3, 0.1}, 4), 0.03));
  for (int i = 0; i < 150; ++i) {
    const double t = 0.01 * i;
    Pose pose;
    pose.translation = Vec3(0.05 * t, 0.02 * std::sin(t), 0.105 + 0.002 * std::sin(3.0 * t));
    pose.rotation = Eigen::AngleAxisd(i % 50 < 25 ? 0.0 : 1e-3 * std::sin(20.0 * t), Vec3::UnitX()) *
                    Eigen::AngleAxisd(0.1 * t, Vec3::UnitZ());
    boxes.check(pose);
  }
  EXPECT_GT(boxes.found(), 100u);
}

TEST(FlatScenes, BoxesInContact) {
  std::mt19937_64 random(5);
  FlatComparison boxes(make_scene(make_box({0.1, 0.1, 0.1}, 2), make_box({0.1, 0.1, 0.1}, 2), 0.02));
  for (int i = 0; i < 30; ++i) {
    Pose pose = turned_on_top(random, i % 3 == 0 ? 0.1 : 0.09);
    if (i % 3 == 2) pose.rotation = testing::random_rotation(random);
    boxes.check(pose);
  }
  EXPECT_GT(boxes.found(), 20u);
}

TEST(FlatScenes, CostsNoMoreForFinerTessellation) {
  // Counts tests, not times: the same contact of the same shapes.
  std::array<WorkCounters, 2> work;
  std::array<LmdSet, 2> sets;
  for (std::size_t k = 0; k < 2; ++k) {
    const int cells = k == 0 ? 2 : 40;
    const Scene scene = make_scene(make_box({1.0, 1.0, 0.1}, cells), make_box({1.2, 0.8, 0.1}, cells), 0.02);
    Pose pose;
    pose.translation = Vec3(0.1, 0.05, 0.101);
    pose.rotation = Eigen::AngleAxisd(0.3, Vec3::UnitZ());
    make_method("certified", scene)->search(pose, sets[k], work[k]);
  }
  ASSERT_EQ(sets[0].size(), 1u);
  ASSERT_EQ(sets[1].size(), 1u);
  EXPECT_LT((sets[0][0].point_fixed - sets[1][0].point_fixed).norm(), 1e-12);
  EXPECT_EQ(work[0].values, work[1].values);
}

}  // namespace
}  // namespace lmdbench
