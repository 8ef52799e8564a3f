// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>
#include <support/parts/parts_scenes.h>

#include <cmath>
#include <set>

namespace lmdbench::parts {
namespace {

TEST(PartsScenes, DependOnTheirChoiceAlone) {
  const PartsChoice choice{"gear on gear", Coordinates::ROUNDED, 3, 7, PoseFamily::ANY};
  PartsChoice next = choice;
  ++next.index;
  const PartsScene one = make_parts_scene(choice), same = make_parts_scene(choice),
                   other = make_parts_scene(next);
  EXPECT_EQ(one.scene.moving->surface().mesh.vertices, same.scene.moving->surface().mesh.vertices);
  EXPECT_EQ(one.poses.back().translation, same.poses.back().translation);
  EXPECT_NE(one.poses.back().translation, other.poses.back().translation);
}

TEST(PartsScenes, ComeInTheCoordinatesTheyName) {
  for (const Coordinates coordinates : ALL_COORDINATES) {
    const PartsScene scene = make_parts_scene({"nut on slotted plate", coordinates, 2, 1, PoseFamily::ANY});
    const double tolerance = scene.scene.fixed[0]->surface().mesh.planar_tolerance;
    EXPECT_EQ(tolerance > 0.0, coordinates == Coordinates::ROUNDED) << name_of(coordinates);
    EXPECT_EQ(scene.poses.size(), POSES_A_SCENE);
  }
}

TEST(PartsScenes, OfOneDesignHaveTheirMeshesInTheSamePlaces) {
  const PartsChoice choice{"T-nut in T-slot", Coordinates::EXACT, 2, 1, PoseFamily::ANY};
  PartsChoice turned = choice;
  turned.coordinates = Coordinates::TURNED;
  const PartsScene one = make_parts_scene(choice), other = make_parts_scene(turned);
  const auto apart = [](const PartsScene& s, std::size_t pose) {
    const RigidTransform X_WM(s.poses[pose]);
    return (X_WM.point(s.scene.moving->surface().mesh.vertices[3]) -
            s.scene.fixed[0]->surface().mesh.vertices[5])
        .norm();
  };
  for (std::size_t i = 0; i < one.poses.size(); ++i) EXPECT_NEAR(apart(one, i), apart(other, i), 1e-14);
}

TEST(PartsScenes, ThatAreFlushHaveNoTilt) {
  for (const PartsKind& kind : parts_kinds()) {
    const PartsScene scene = make_parts_scene({kind.name, Coordinates::EXACT, 1, 0, PoseFamily::FLUSH});
    for (const Pose& pose : scene.poses) {
      EXPECT_EQ(pose.rotation.x(), 0.0) << kind.name;
      EXPECT_EQ(pose.rotation.y(), 0.0) << kind.name;
      for (const double x : pose.translation) EXPECT_EQ(std::ldexp(x, 24), std::round(std::ldexp(x, 24)));
    }
  }
}

TEST(PartsScenes, OfRandomSolidsAreSoundAndDiffer) {
  for (const PartsKind& kind : parts_kinds(Generator::RANDOM_SOLIDS)) {
    std::set<std::size_t> triangles;
    for (std::size_t index = 0; index < 8; ++index) {
      const PartsDesign design =
          make_parts_design({kind.name, Coordinates::EXACT, 1, index, PoseFamily::ANY});
      const ValidityReport report = check_mesh(build_surface(design.moving));
      EXPECT_TRUE(report.closed && report.manifold && report.outward.value_or(false)) << kind.name;
      EXPECT_EQ(report.components, 1) << kind.name;
      triangles.insert(design.moving.triangles.size());
    }
    EXPECT_GT(triangles.size(), 3u) << kind.name;
  }
}

TEST(PartsScenes, RefuseAnUnknownKind) {
  EXPECT_THROW(parts_kind("gear on goat"), UsageError);
}

}  // namespace
}  // namespace lmdbench::parts
