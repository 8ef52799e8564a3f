// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>
#include <support/parts/rest_drawing.h>
#include <support/parts/rest_fits.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace lmdbench::parts {
namespace {

/// Numbers of meetings of faces, edges and corners.
std::array<std::size_t, 3> meetings_of(std::string_view drawing) {
  std::array<std::size_t, 3> counts{};
  const RestDrawing parts(drawing);
  for (const RestDrawing::Meeting& meeting : parts.meetings()) ++counts[meeting.axes.size() - 1];
  return counts;
}

using Counts = std::array<std::size_t, 3>;

TEST(RestDrawing, KnowsWhereItsPartsMeet) {
  EXPECT_EQ(meetings_of("A/B"), (Counts{1, 0, 0}));
  EXPECT_EQ(meetings_of("B../BA./BBB"), (Counts{2, 0, 0}));
  // With a wall at the back: the corner of a room.
  EXPECT_EQ(meetings_of("B../BA./BBB;B../BB./BBB"), (Counts{3, 0, 0}));
  // Two lips, two sides of the neck and of the head, and the floor.
  EXPECT_EQ(meetings_of("BBABB/BAAAB/BBBBB"), (Counts{7, 0, 0}));
  EXPECT_EQ(meetings_of(".B./.B.;AAA/ABA;.B./.B."), (Counts{5, 0, 0}));
  // A ring is one place.
  EXPECT_EQ(meetings_of("BBB/BAB/BBB;AAA/AAA/AAA"), (Counts{5, 0, 0}));
  EXPECT_EQ(meetings_of("A./.B"), (Counts{0, 1, 0}));
  EXPECT_EQ(meetings_of("A./..;../.B"), (Counts{0, 0, 1}));
}

TEST(RestDrawing, IsSoundWherePartsAreManifoldsAndLinesHaveOneSide) {
  EXPECT_TRUE(RestDrawing("BAB/BBB").is_sound());
  EXPECT_FALSE(RestDrawing("AB/BA").is_sound());
  EXPECT_FALSE(RestDrawing("A../..B").is_sound()) << "nothing meets";
  // A is left of the line above, right of it below.
  EXPECT_FALSE(RestDrawing("AB/.B/.B/BB/B./BA").is_sound());
  EXPECT_FALSE(RestDrawing("A./..;BB/.A").is_sound()) << "two corners of A in one";
}

TEST(RestFits, AreSoundParts) {
  EXPECT_GE(rest_fits().size(), 20u);
  std::set<std::string> names;
  for (const RestFit& fit : rest_fits()) {
    EXPECT_TRUE(names.insert(fit.name).second);
    EXPECT_TRUE(RestDrawing(fit.drawing).is_sound()) << fit.name;
    for (std::size_t index = 0; index < 3; ++index) {
      const RestScene scene = make_rest_scene(fit, 5, index);
      EXPECT_FALSE(scene.places.empty()) << scene.text;
      for (const Body* body : {scene.scene.moving.get(), scene.scene.fixed[0].body.get()}) {
        const ValidityReport report = check_mesh(body->surface());
        EXPECT_TRUE(report.closed && report.manifold && report.outward.value_or(false)) << scene.text;
      }
    }
  }
}

TEST(RestFits, DependOnTheirNumbersAlone) {
  const RestFit& fit = rest_fit("T-nut in T-slot");
  const auto vertices = [&](std::uint64_t seed, std::size_t index) {
    return make_rest_scene(fit, seed, index).scene.moving->surface().mesh.vertices;
  };
  EXPECT_EQ(vertices(1, 2), vertices(1, 2));
  EXPECT_NE(vertices(1, 2), vertices(1, 3));
  EXPECT_NE(vertices(1, 2), vertices(2, 2));
}

TEST(RestFits, HaveTheirGaps) {
  // Both parts' planes at a place, found by their world normals, are the gap apart.
  for (const RestFit& fit : rest_fits()) {
    const RestScene scene = make_rest_scene(fit, 3, 1);
    if (scene.single_precision) continue;
    const RigidTransform X_WD(scene.X_WD), X_WM(scene.X_WM);
    for (const RestPlace& place : scene.places) {
      if (place.dimension < 2) continue;
      const Vec3 u = X_WD.direction(place.direction);
      const auto heights = [&](const Surface& surface, const RigidTransform& X, double sign) {
        std::set<double> result;
        for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i)
          if (X.direction(surface.face_normals[i]).dot(sign * u) > 1.0 - 1e-9)
            result.insert(u.dot(X.point(surface.mesh.triangle(static_cast<std::int32_t>(i))[0])));
        return result;
      };
      double nearest = 1.0;
      for (const double p : heights(scene.scene.moving->surface(), X_WM, 1.0))
        for (const double q : heights(scene.scene.fixed[0]->surface(), RigidTransform(), -1.0))
          nearest = std::min(nearest, std::abs(q - p - place.gap));
      EXPECT_LE(nearest, 1e-14 * 12.0 * scene.size) << scene.text;
    }
  }
}

}  // namespace
}  // namespace lmdbench::parts
