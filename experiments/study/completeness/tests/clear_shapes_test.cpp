// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/flat_regions.h>

#include <gtest/gtest.h>
#include <study/completeness/parts_study.h>
#include <study/completeness/rounded_plates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace lmdbench::completeness {
namespace {

using parts::Coordinates;
using parts::Generator;
using parts::PartsKind;
using parts::PartsScene;

LmdSet truth_of(const PartsScene& flat, const Pose& pose) {
  return lmds_at(*make_method("exhaustive", flat.scene), pose);
}

/// Distances of a contact's points from vertices of their meshes: the same in every frame.
std::array<double, 6> place_of(const PartsScene& flat, const Pose& pose, const Lmd& lmd) {
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

/// Some sides of a gear meet at so small an angle that an import does not move their vertices
/// (LARGEST_MOVE): a side of two triangles stays two regions.
bool has_its_planes_apart(const std::string& pair) {
  return pair.find("gear") == std::string::npos;
}

/// The largest distance between contacts of the two sets [m]; infinite where their numbers differ.
double farthest_apart(const PartsScene& one, const PartsScene& other, std::size_t pose) {
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

TEST(ClearShapes, HaveTheSameContactsWhateverTheirCoordinates) {
  // The design is the same, so the contacts are too; those of the design are exact.
  std::size_t poses = 0, faces = 0;
  for (const PartsKind& kind : parts::parts_kinds(Generator::CLEAR_SHAPES)) {
    for (const std::size_t index : {0u, 2u, 3u}) {
      const PartsScene made = parts::make_parts_scene({kind.name, Coordinates::EXACT, 3, index});
      const PartsScene turned = parts::make_parts_scene({kind.name, Coordinates::TURNED, 3, index});
      const PartsScene floats = parts::make_parts_scene({kind.name, Coordinates::ROUNDED, 3, index});
      SCOPED_TRACE(std::string(kind.name) + ", scene " + std::to_string(index));
      if (has_its_planes_apart(kind.name)) {
        EXPECT_EQ(floats.scene.fixed[0]->prepared<FlatRegions>().region_count(),
                  made.scene.fixed[0]->prepared<FlatRegions>().region_count());
      }
      for (std::size_t i = 0; i < made.poses.size(); i += 2) {
        const LmdSet truth = truth_of(made, made.poses[i]);
        ++poses;
        EXPECT_LT(farthest_apart(made, turned, i), 1e-9) << "turned, pose " << i;
        EXPECT_LT(farthest_apart(made, floats, i), 1e-5) << "floats, pose " << i;
        faces += std::any_of(truth.begin(), truth.end(), [](const Lmd& lmd) {
          return lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
        });
      }
    }
  }
  EXPECT_GT(2 * faces, poses);
}

TEST(ClearShapes, AreSearchedWithoutLoss) {
  std::string wrong;
  std::size_t lmds = 0;
  PartsStudy study;
  study.poses = 20;
  study.seed = 3;
  for (const PartsKind& kind : parts::parts_kinds(Generator::CLEAR_SHAPES))
    for (const Coordinates coordinates : {Coordinates::EXACT, Coordinates::TURNED, Coordinates::ROUNDED})
      lmds += judge_parts(study, kind.name, coordinates, [&](const std::string& what) {
                wrong += what + "\n";
              }).true_lmds;
  EXPECT_EQ(wrong, "");
  EXPECT_GT(lmds, 450u);
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
