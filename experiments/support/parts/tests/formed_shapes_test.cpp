// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>
#include <support/parts/formed_shapes.h>
#include <support/parts/parts_scenes.h>

#include <algorithm>
#include <set>
#include <string>

namespace lmdbench::parts {
namespace {

void expect_solid(const TriangleMesh& mesh) {
  const ValidityReport report = check_mesh(build_surface(mesh));
  EXPECT_TRUE(report.closed && report.manifold && report.consistently_oriented);
  EXPECT_TRUE(report.outward.value_or(false));
  EXPECT_EQ(report.components, 1);
}

TEST(FormedShapes, AreWhatTheirNamesSay) {
  const std::set<std::string> solids = {"turned part", "slit block", "thin plate", "stellated solid", "coil"};
  for (const FormedShape& shape : formed_shapes()) {
    SCOPED_TRACE(shape.name);
    experiments::Random random(3);
    std::set<std::size_t> triangles;
    for (int i = 0; i < 20; ++i) {
      const TriangleMesh mesh = shape.make(random);
      triangles.insert(mesh.triangles.size());
      EXPECT_LT(mesh.triangles.size(), 600u) << "exhaustive has to keep up";
      EXPECT_GT(bounding_box_diagonal(mesh), 0.4);
      EXPECT_LT(bounding_box_diagonal(mesh), 3.0);
      if (solids.contains(shape.name)) expect_solid(mesh);
    }
    EXPECT_GT(triangles.size(), 3u);
  }
}

TEST(FormedShapes, ThatAreMatesFillEachOther) {
  experiments::Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Mates turned = random_turned_mates(random), relief = random_relief_mates(random);
    for (const TriangleMesh* mesh : {&turned.inner, &turned.outer, &relief.inner, &relief.outer})
      expect_solid(*mesh);
    // Every corner of the inner one is one of the outer one, except those of lid and axis.
    const auto shared = [](const Mates& mates) {
      std::size_t count = 0;
      for (const Vec3& p : mates.inner.vertices)
        count +=
            static_cast<std::size_t>(std::count(mates.outer.vertices.begin(), mates.outer.vertices.end(), p));
      return count;
    };
    EXPECT_EQ(shared(turned), turned.inner.vertices.size() - 2);
    EXPECT_EQ(2 * shared(relief), relief.inner.vertices.size());
  }
}

TEST(FormedShapes, MakeScenesInAllCoordinates) {
  for (const PartsKind& kind : parts_kinds(Generator::FORMED_SHAPES))
    for (const Coordinates coordinates : ALL_COORDINATES) {
      SCOPED_TRACE(std::string(kind.name) + ", " + name_of(coordinates));
      const PartsScene one = make_parts_scene({kind.name, coordinates, 1, 2}),
                       same = make_parts_scene({kind.name, coordinates, 1, 2});
      EXPECT_EQ(one.scene.moving->surface().mesh.vertices, same.scene.moving->surface().mesh.vertices);
      ASSERT_EQ(one.poses.size(), POSES_A_SCENE);
      for (std::size_t i = 0; i < POSES_A_SCENE; ++i) {
        EXPECT_EQ(one.poses[i].translation, same.poses[i].translation);
        EXPECT_TRUE(one.poses[i].translation.allFinite() && one.poses[i].rotation.coeffs().allFinite());
      }
    }
}

}  // namespace
}  // namespace lmdbench::parts
