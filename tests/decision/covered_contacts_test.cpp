// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/decision/covered_contacts.h>

#include <gtest/gtest.h>
#include <support/closed_solids.h>
#include <support/lmd_text.h>
#include <support/rounded.h>
#include <support/shape_scene.h>
#include <support/sheets.h>
#include <support/sleeves.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using testing::make_gear;
using testing::make_ring;
using testing::moved;
using testing::ShapeScene;
using testing::text;
using testing::turned_by;
using testing::uniform;

TriangleMesh plate() {
  return make_box({3.0, 3.0, 0.2}, 1);
}

/// LMDs of contacts when none is dropped as covered.
LmdSet joined_whole(const ShapePair& pair, ContactSet contacts) {
  for (Contact& contact : contacts.contacts) contact.is_whole = false;
  return testing::joined(pair, contacts);
}

std::size_t covered(const ShapePair& pair, ContactSet contacts) {
  return take_covered(pair, contacts.contacts).size();
}

/// Puts the mesh on the plane z = 0, or hangs it below, with its middle over the origin.
TriangleMesh at_plane(TriangleMesh mesh, bool stands) {
  Eigen::AlignedBox3d box;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  const Vec3 middle = box.center();
  return translated(std::move(mesh),
                    Vec3(-middle.x(), -middle.y(), stands ? -box.min().z() : -box.max().z()));
}

TEST(CoveredContacts, LmdsAreTheSameWithoutWhatIsCovered) {
  std::mt19937_64 random(1);
  const std::vector<std::pair<TriangleMesh, TriangleMesh>> pairs{
      {make_ring(0.5, 0.3, 24, 1), make_ring(0.45, 0.35, 30, 1)},
      {make_gear(7), make_gear(9)},
      {make_gear(11), plate()},
      {plate(), make_ring(0.5, 0.3, 24, 1)},
      {testing::make_voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 1, 1}}), plate()},
      {testing::make_plate_with_holes(3), make_box({0.7, 0.6, 0.3})}};
  std::size_t less = 0, all = 0;
  for (const auto& [moving, fixed] : pairs)
    for (int k = 0; k < 40; ++k) {
      const Pose whole = k % 2 == 0 ? Pose{} : testing::pose_of_seed(static_cast<std::uint64_t>(k));
      const auto placed = [&](const TriangleMesh& mesh, bool stands) {
        TriangleMesh result = testing::placed(at_plane(mesh, stands), whole);
        return k % 3 == 2 ? testing::rounded_to_floats(std::move(result)) : result;
      };
      ShapeScene scene(placed(moving, true), placed(fixed, false));
      // Gaps from almost touching; tilts within the tolerance and beyond it.
      const double gap = std::pow(10.0, -8.0 + 7.0 * uniform(random));
      const double tilt = k % 4 == 0 ? 0.0 : std::pow(10.0, -12.0 + 8.0 * uniform(random));
      const Pose pose =
          moved(0.6 * uniform(random) - 0.3, 0.6 * uniform(random) - 0.3, gap) *
          turned_by(tilt, Vec3(uniform(random) - 0.5, uniform(random) - 0.5, 0.0), Vec3::Zero()) *
          turned_by(6.28 * uniform(random), Vec3::UnitZ(), Vec3::Zero());
      const ShapePair pair = scene.at(whole * pose * whole.inverse());
      const ContactSet contacts = scene.contacts(pair);
      LmdSet lmds;
      ContactSet own = contacts;
      lmds = testing::joined(pair, own);
      LmdSet expected = joined_whole(pair, contacts);
      std::ranges::sort(lmds, lmd_less);
      std::ranges::sort(expected, lmd_less);
      ASSERT_EQ(text(lmds), text(expected)) << "pose " << k;
      all += contacts.contacts.size();
      less += covered(pair, contacts);
    }
  EXPECT_GT(less, 300u) << "of " << all;
}

TEST(CoveredContacts, KeepsTheBorderAndAllNextToTouch) {
  // The box's corners are 1e-8 inside the plate's border, or far inside.
  ShapeScene scene(at_plane(make_box({1.0, 1.0, 1.0}), true), at_plane(make_box({3.0, 3.0, 1.0}), false));
  const auto covered_at = [&](const Pose& pose) {
    const ShapePair pair = scene.at(pose);
    return covered(pair, scene.contacts(pair));
  };
  EXPECT_EQ(covered_at(moved(0.0, 0.0, 0.01)), 8u) << "four corners and four chains";
  EXPECT_EQ(covered_at(moved(1.0 - 1e-9, 0.0, 0.01)), 3u)
      << "one chain, its ends and the chains that end there stay";
  EXPECT_EQ(covered_at(moved(1.1, 0.0, 0.01)), 3u) << "over the border";
  EXPECT_EQ(covered_at(moved(0.0, 0.0, 1e-7)), 0u);
}

TEST(CoveredContacts, TwoShouldersThatAWallJoinsAreOneLmd) {
  // The T's neck goes through the plate; along it a level path joins the shoulders' corners.
  const TriangleMesh nut = testing::make_voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 1}});
  ShapeScene scene(nut, translated(make_box({9.0, 9.0, 0.5}), Vec3(1.5, 0.5, 1.375)), 0.5);
  const ShapePair pair = scene.at(Pose{});
  ContactSet contacts = scene.contacts(pair);
  std::erase_if(contacts.contacts,
                [](const Contact& contact) { return std::abs(contact.distance - 0.125) > 1e-9; });
  EXPECT_EQ(std::ranges::count(contacts.contacts, 2, &Contact::dimension), 2);
  EXPECT_EQ(covered(pair, contacts), 0u);
  LmdSet lmds = testing::joined(pair, contacts);
  ASSERT_EQ(lmds.size(), 1u) << text(lmds);
  EXPECT_NEAR((lmds[0].point_fixed - Vec3(1.5, 0.5, 1.125)).norm(), 0.0, 1e-12);
}

TEST(CoveredContacts, APolygonOverOneLegDoesNotSpeakForTheOther) {
  // A tilted bar over both legs of a U: it is level to the tolerance over the narrow leg alone.
  ShapeScene scene(
      at_plane(make_box({0.8, 0.2, 0.1}), true),
      testing::sheet_of({"##########", "#.########", "#.########", "#.########", "#.########"}, 0.1));
  std::size_t of_one_leg = 0;
  for (const double tilt : {-1e-8, 1e-8, -3e-9, 3e-9}) {
    const ShapePair pair = scene.at(turned_by(tilt, Vec3::UnitY(), Vec3(-0.02, -0.05, 0.01)));
    const ContactSet contacts = scene.contacts(pair);
    const auto polygons = std::ranges::count(contacts.contacts, 2, &Contact::dimension);
    of_one_leg += polygons == 1 ? 1 : 0;
    if (polygons == 1) {
      EXPECT_EQ(covered(pair, contacts), 0u) << tilt;
    }
    ContactSet own = contacts;
    LmdSet lmds = testing::joined(pair, own);
    EXPECT_EQ(text(lmds), text(joined_whole(pair, contacts))) << tilt;
  }
  EXPECT_GT(of_one_leg, 1u);
}

TEST(CoveredContacts, WithoutAPairOfPointsThereIsNoLmd) {
  // The recess is level to the tolerance, but all round its border the distance decreases.
  std::set<testing::Voxel> recess;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 2; ++z) recess.insert({x, y, z});
  recess.erase(testing::Voxel{1, 1, 0});
  ShapeScene scene(at_plane(testing::make_voxels(recess), true), at_plane(make_box({9.0, 9.0, 1.0}), false),
                   3.0);
  const ShapePair pair = scene.at(moved(0.0, 0.0, 0.5));
  ContactSet contacts = scene.contacts(pair);
  take_covered(pair, contacts.contacts);
  std::size_t over_recess = 0;
  for (const Contact& contact : contacts.contacts)
    if (contact.dimension == 2 && contact.distance > 1.0) {
      ++over_recess;
      EXPECT_FALSE(contact.covers_point);
    } else if (contact.dimension == 2) {
      EXPECT_TRUE(contact.covers_point);
    }
  EXPECT_EQ(over_recess, 1u);
  EXPECT_EQ(scene.lmds(moved(0.0, 0.0, 0.5)).size(), 1u);
}

}  // namespace
}  // namespace lmdbench
