// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/flat_regions.h>

#include <gtest/gtest.h>
#include <study/completeness/flat_scenes.h>
#include <study/completeness/rounded_plates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace lmdbench::completeness {
namespace {

LmdSet truth_of(const FlatScene& flat, const Pose& pose) {
  LmdSet lmds;
  WorkCounters counters;
  make_method("exhaustive", flat.scene)->search(pose, lmds, counters);
  return lmds;
}

TEST(FlatScenesOfTheStudy, DependOnTheirNumbersAlone) {
  const FlatScene one = make_flat_scene(0, FlatCoordinates::FLOATS, 3, 7);
  const FlatScene same = make_flat_scene(0, FlatCoordinates::FLOATS, 3, 7);
  const FlatScene other = make_flat_scene(0, FlatCoordinates::FLOATS, 3, 8);
  EXPECT_EQ(one.label, same.label);
  EXPECT_EQ(one.poses.back().translation, same.poses.back().translation);
  EXPECT_EQ(one.scene.moving->surface().mesh.vertices, same.scene.moving->surface().mesh.vertices);
  EXPECT_NE(one.poses.back().translation, other.poses.back().translation);
}

/// Distances of a contact's points from vertices of their meshes: the same in every frame.
std::array<double, 6> place_of(const FlatScene& flat, const Pose& pose, const Lmd& lmd) {
  std::array<double, 6> place{};
  const RigidTransform X_WM(pose);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& moving = flat.scene.moving->surface().mesh.vertices;
    const auto& fixed = flat.scene.fixed[0]->surface().mesh.vertices;
    place[k] = (lmd.point_moving - X_WM.point(moving[k * (moving.size() - 1) / 2])).norm();
    place[3 + k] = (lmd.point_fixed - fixed[k * (fixed.size() - 1) / 2]).norm();
  }
  return place;
}

/// Some sides of a gear meet at so small an angle that an import leaves them as they are (LARGEST_MOVE): a side of two
/// triangles is two regions.
bool has_its_planes_apart(const std::string& pair) {
  return pair.find("gear") == std::string::npos;
}

/// How far the contacts of one set are from those of another one, at worst [m]; infinite where they are not as many.
double farthest_apart(const FlatScene& one, const FlatScene& other, std::size_t pose) {
  const LmdSet a = truth_of(one, one.poses[pose]), b = truth_of(other, other.poses[pose]);
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double worst = 0.0;
  for (const Lmd& lmd : a) {
    const auto place = place_of(one, one.poses[pose], lmd);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Lmd& candidate : b) {
      const auto where = place_of(other, other.poses[pose], candidate);
      double apart = 0.0;
      for (std::size_t k = 0; k < 6; ++k) apart = std::max(apart, std::abs(place[k] - where[k]));
      nearest = std::min(nearest, apart);
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(FlatScenesOfTheStudy, HaveTheSameContactsWhateverTheirCoordinates) {
  // The design is the same, so are the contacts: those of the design are exact.
  std::size_t poses = 0, faces = 0;
  for (std::size_t pair = 0; pair < flat_pairs().size(); ++pair) {
    for (const std::size_t index : {0u, 2u}) {
      const FlatScene made = make_flat_scene(pair, FlatCoordinates::AS_MADE, 3, index);
      const FlatScene turned = make_flat_scene(pair, FlatCoordinates::TURNED, 3, index);
      const FlatScene floats = make_flat_scene(pair, FlatCoordinates::FLOATS, 3, index);
      EXPECT_EQ(made.scene.moving->surface().mesh.planar_tolerance, 0.0);
      EXPECT_EQ(turned.scene.moving->surface().mesh.planar_tolerance, 0.0);
      EXPECT_GT(floats.scene.fixed[0]->surface().mesh.planar_tolerance, 0.0) << floats.label;
      if (has_its_planes_apart(flat_pairs()[pair])) {
        EXPECT_EQ(floats.scene.fixed[0]->prepared<FlatRegions>().region_count(),
                  made.scene.fixed[0]->prepared<FlatRegions>().region_count())
            << floats.label;
      }
      for (std::size_t i = 0; i < made.poses.size(); i += index == 0 ? 5 : 2) {
        const LmdSet truth = truth_of(made, made.poses[i]);
        ++poses;
        EXPECT_LT(farthest_apart(made, turned, i), 1e-9) << turned.label << ", pose " << i;
        EXPECT_LT(farthest_apart(made, floats, i), 1e-5) << floats.label << ", pose " << i;
        faces += std::any_of(truth.begin(), truth.end(), [](const Lmd& lmd) {
          return lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
        });
      }
    }
  }
  EXPECT_GT(2 * faces, poses);
}

TEST(FlatScenesOfTheStudy, AreSearchedWithoutLoss) {
  std::string wrong;
  std::size_t lmds = 0;
  for (std::size_t pair = 0; pair < flat_pairs().size(); ++pair) {
    for (const FlatCoordinates coordinates :
         {FlatCoordinates::AS_MADE, FlatCoordinates::TURNED, FlatCoordinates::FLOATS}) {
      const FlatScene flat = make_flat_scene(pair, coordinates, 3, 0);
      const auto judged =
          judge_poses(flat.scene, flat.diagonal, {flat.scene.cutoff / flat.diagonal}, flat.poses,
                      [&](const std::string& what) { wrong += flat.label + ", " + what; });
      for (const Judgement& judgement : judged.front().judgements) lmds += judgement.same.true_lmds;
    }
  }
  EXPECT_EQ(wrong, "");
  EXPECT_GT(lmds, 1400u);
}

TEST(RoundedPlatesOfTheStudy, AreOneContactWhereTheDesignHasIt) {
  std::string objections;
  const RoundedPlates plates =
      judge_rounded_plates(4, 1, 20, [&](const std::string& what) { objections += what; });
  EXPECT_EQ(objections, "");
  EXPECT_EQ(plates.triangles, 96u);
  EXPECT_EQ(plates.one_lmd, 20u);
  EXPECT_GT(plates.worst_point, 0.0) << "rounding shows";
  EXPECT_LT(plates.worst_point, 1e-5);
  EXPECT_GT(plates.worst_direction, 0.0);
  EXPECT_LT(plates.worst_direction, ROUNDED_DIRECTION_RAD);
}

}  // namespace
}  // namespace lmdbench::completeness
