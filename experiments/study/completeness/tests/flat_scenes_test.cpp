// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/flat_regions.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <study/completeness/flat_scenes.h>
#include <study/completeness/rounded_plates.h>

#include <algorithm>
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

/// Rounding leaves the end of a gear in several regions (completeness.md).
bool keeps_its_regions(const std::string& pair) {
  return pair.find("gear") == std::string::npos;
}

TEST(FlatScenesOfTheStudy, HaveTheSameContactsWhateverTheirCoordinates) {
  // The design is the same, so is the number of contacts.
  std::size_t poses = 0, faces = 0;
  for (std::size_t pair = 0; pair < flat_pairs().size(); ++pair) {
    if (!keeps_its_regions(flat_pairs()[pair])) continue;
    const FlatScene made = make_flat_scene(pair, FlatCoordinates::AS_MADE, 3, 0);
    const FlatScene turned = make_flat_scene(pair, FlatCoordinates::TURNED, 3, 0);
    const FlatScene floats = make_flat_scene(pair, FlatCoordinates::FLOATS, 3, 0);
    EXPECT_EQ(made.scene.moving->surface().mesh.planar_tolerance, 0.0);
    EXPECT_EQ(turned.scene.moving->surface().mesh.planar_tolerance, 0.0);
    EXPECT_GT(floats.scene.fixed[0]->surface().mesh.planar_tolerance, 0.0) << floats.label;
    EXPECT_EQ(floats.scene.fixed[0]->prepared<FlatRegions>().region_count(),
              made.scene.fixed[0]->prepared<FlatRegions>().region_count())
        << floats.label;
    for (std::size_t i = 0; i < made.poses.size(); i += 5) {
      const LmdSet truth = truth_of(made, made.poses[i]);
      ++poses;
      EXPECT_EQ(truth_of(turned, turned.poses[i]).size(), truth.size()) << turned.label << ", pose " << i;
      EXPECT_EQ(truth_of(floats, floats.poses[i]).size(), truth.size()) << floats.label << ", pose " << i;
      faces += std::any_of(truth.begin(), truth.end(), [](const Lmd& lmd) {
        return lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
      });
    }
  }
  EXPECT_GT(2 * faces, poses);
}

TEST(FlatScenesOfTheStudy, AreSearchedWithoutLossAsMadeAndRounded) {
  std::string wrong;
  std::size_t lmds = 0;
  for (std::size_t pair = 0; pair < flat_pairs().size(); ++pair) {
    for (const FlatCoordinates coordinates : {FlatCoordinates::AS_MADE, FlatCoordinates::FLOATS}) {
      if (coordinates == FlatCoordinates::FLOATS && !keeps_its_regions(flat_pairs()[pair])) continue;
      const FlatScene flat = make_flat_scene(pair, coordinates, 3, 0);
      const auto judged =
          judge_poses(flat.scene, flat.diagonal, {flat.scene.cutoff / flat.diagonal}, flat.poses,
                      [&](const std::string& what) { wrong += flat.label + ", " + what; });
      for (const Judgement& judgement : judged.front().judgements) lmds += judgement.same.true_lmds;
    }
  }
  EXPECT_EQ(wrong, "");
  EXPECT_GT(lmds, 900u);
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
