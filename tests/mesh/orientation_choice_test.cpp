// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/mesh/orientation_choice.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/mesh/winding_number.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

TEST(OrientOutward, SoundSolidsAreLeftAsTheyAre) {
  for (const TriangleMesh& mesh : {make_sphere(1, 2), make_torus(1, 0.3, 16, 8), make_l_block(1)}) {
    TriangleMesh turned = mesh;
    const OrientationReport report = orient_outward(turned);
    EXPECT_EQ(turned.triangles, mesh.triangles);
    EXPECT_EQ(report.turned_triangles, 0);
    EXPECT_EQ(report.pieces, 1);
    EXPECT_EQ(report.disagreements, 0);
  }
}

TEST(OrientOutward, WhatIsInsideOutIsTurned) {
  const TriangleMesh sound = make_torus(1, 0.3, 16, 8);
  TriangleMesh mesh = inside_out(sound);
  const OrientationReport report = orient_outward(mesh);
  EXPECT_EQ(mesh.triangles, sound.triangles);
  EXPECT_EQ(report.turned_triangles, static_cast<std::int64_t>(sound.triangles.size()));
  EXPECT_THAT(to_text(report), HasSubstr("256 triangles turned outward"));
}

TEST(OrientOutward, SingleTurnedTrianglesJoinTheirNeighbours) {
  const TriangleMesh sound = make_sphere(1, 2);
  for (const bool turned_first : {false, true}) {
    TriangleMesh mesh = with_flips(sound, 7);
    if (turned_first) mesh = inside_out(mesh);
    orient_outward(mesh);
    const ValidityReport report = check_mesh(build_surface(mesh));
    EXPECT_TRUE(report.consistently_oriented);
    EXPECT_EQ(report.outward, true);
  }
}

/// A ball has a bubble inside, and another ball floats in that.
TEST(OrientOutward, CavitiesFaceTheirInside) {
  for (const int wrong : {0, 1, 2, 3}) {
    TriangleMesh shells[] = {make_sphere(3, 2), inside_out(make_sphere(2, 2)), make_sphere(1, 2)};
    if (wrong < 3) shells[wrong] = inside_out(shells[wrong]);
    TriangleMesh mesh = merged(merged(shells[0], shells[1]), shells[2]);
    const OrientationReport report = orient_outward(mesh);
    EXPECT_EQ(report.pieces, 3);
    EXPECT_EQ(report.turned_triangles, wrong < 3 ? static_cast<std::int64_t>(shells[0].triangles.size()) : 0)
        << wrong;
    const double shell = *check_mesh(build_surface(make_sphere(1, 2))).volume;
    EXPECT_NEAR(*check_mesh(build_surface(mesh)).volume, shell * (27.0 - 8.0 + 1.0), 1e-9);
  }
}

/// However the corners are numbered: the first may lie on the other piece.
TEST(OrientOutward, PiecesThatTouchAreEnclosedOnlyIfTheyAreInside) {
  const TriangleMesh box = make_box({1, 1, 1}), nook = make_l_block(2);
  TriangleMesh small = make_box({0.5, 0.5, 0.5});
  const struct {
    TriangleMesh sound;
    const char* what;
  } scenes[] = {
      {merged(translated(box, {-0.5, 0, 0}), translated(box, {0.5, 0, 0})), "face on face"},
      {merged(translated(box, {-0.5, 0.3, 0}), translated(small, {0.25, 0, 0})), "a small one on a face"},
      {merged(nook, translated(make_box({0.5, 0.5, 0.5}), {0.25, bounding_box_centre(nook).y(), 0.25})),
       "in the nook of an L"},
      {merged(box, inside_out(translated(small, {0.25, 0, 0}))), "a cavity up to a face"},
      {merged(box, inside_out(translated(small, {0.25, 0.25, 0.25}))), "a cavity up to a corner"}};
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  for (int turns = 0; turns < 50; ++turns) {
    const auto& [upright, what] = scenes[turns % std::ssize(scenes)];
    TriangleMesh sound = upright;
    for (Vec3& vertex : sound.vertices) vertex = Eigen::AngleAxisd(0.3 * turns, axis) * vertex;
    for (std::size_t first = 0; first < sound.triangles.size(); ++first) {
      TriangleMesh mesh = sound;
      std::ranges::rotate(mesh.triangles, mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first));
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (auto& corners : mesh.triangles) std::ranges::rotate(corners, corners.begin() + 1);
        EXPECT_EQ(orient_outward(mesh).turned_triangles, 0) << what << ", " << first << ", " << corner;
      }
    }
  }
}

TEST(NearWinding, IsTheSumOverAllTriangles) {
  const TriangleMesh mesh = make_torus(1, 0.3, 48, 24);
  std::vector<std::int32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const NearWinding near(mesh, all);
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 point(1.5 * std::sin(i), 1.5 * std::sin(2.3 * i), 0.4 * std::sin(3.1 * i));
    const double exact = winding_number(point, mesh);
    EXPECT_NEAR(near.at(point), exact, 0.05) << i;
    inside += exact > 0.5 ? 1 : 0;
  }
  EXPECT_GT(inside, 10);
}

TEST(OrientOutward, ACopyIsNoCavity) {
  TriangleMesh mesh = merged(make_sphere(1, 2), make_sphere(1, 2));
  EXPECT_EQ(orient_outward(mesh).turned_triangles, 0);
}

/// One end of the bar lies within the L, the other in its nook, and its box within the L's.
TEST(OrientOutward, APieceThatSticksOutIsNoCavity) {
  const TriangleMesh nook = make_l_block(2);
  const TriangleMesh bar =
      translated(make_box({0.2, 1.6, 0.2}, 2), {0.3, 0.0, bounding_box_centre(nook).z()});
  for (std::size_t first = 0; first < bar.triangles.size(); ++first) {
    TriangleMesh mesh = merged(bar, nook);
    std::ranges::rotate(mesh.triangles, mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first));
    EXPECT_EQ(orient_outward(mesh).turned_triangles, 0) << first;
  }
}

/// Welded along an edge, where four triangles meet: either one is closed.
TEST(OrientOutward, PiecesThatShareAnEdgeAreClosed) {
  TriangleMesh mesh = translated(make_box({1, 1, 1}), {-0.5, 0, -0.5});
  const TriangleMesh other = translated(make_box({1, 1, 1}), {0.5, 0, 0.5});
  std::vector<int> number;
  for (const Vec3& vertex : other.vertices) {
    const auto found = std::ranges::find(mesh.vertices, vertex);
    number.push_back(static_cast<int>(found - mesh.vertices.begin()));
    if (found == mesh.vertices.end()) mesh.vertices.push_back(vertex);
  }
  EXPECT_EQ(mesh.vertices.size(), 14U);
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(c)],
                              number[static_cast<std::size_t>(b)]});
  const OrientationReport report = orient_outward(mesh);
  EXPECT_EQ(report.pieces, 2);
  EXPECT_EQ(report.pieces_undecided, 0);
  EXPECT_EQ(report.turned_triangles, 12);
  // A cavity is decided for closed pieces alone: one within such a pair.
  TriangleMesh hollow = merged(mesh, translated(make_box({0.2, 0.2, 0.2}), {0.5, 0, 0.5}));
  EXPECT_EQ(orient_outward(hollow).turned_triangles, 12);
}

TEST(OrientOutward, ScansWithHolesAreTurned) {
  TriangleMesh mesh = with_holes(inside_out(make_sphere(1, 2)), 50);
  const auto count = static_cast<std::int64_t>(mesh.triangles.size());
  const OrientationReport report = orient_outward(mesh);
  EXPECT_EQ(report.turned_triangles, count);
  EXPECT_EQ(report.pieces_undecided, 0);
}

TEST(OrientOutward, SheetsHaveNoOuterSide) {
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 3, 2}};  // they disagree
  const OrientationReport report = orient_outward(sheet);
  EXPECT_EQ(report.turned_triangles, 1) << "one of the two";
  EXPECT_EQ(report.pieces_undecided, 1);
  EXPECT_THAT(to_text(report), HasSubstr("without an outer side"));
}

/// Five quads in a ring whose ends are joined upside down.
TEST(OrientOutward, AMoebiusStripStillDisagreesSomewhere) {
  TriangleMesh strip;
  constexpr int COUNT = 8;
  for (int i = 0; i < COUNT; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / COUNT;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1.0 + side * std::cos(angle / 2);
      strip.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), side * std::sin(angle / 2));
    }
  }
  for (int i = 0; i < COUNT; ++i) {
    const int a = 2 * i, b = 2 * i + 1;
    const int c = i + 1 < COUNT ? a + 2 : 1, d = i + 1 < COUNT ? b + 2 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  EXPECT_GE(orient_outward(strip).disagreements, 1);
}

TEST(OrientOutward, NamesAreChecked) {
  EXPECT_EQ(parse_orientation("outward", "", "/moving/orient"), OrientationChoice::OUTWARD);
  EXPECT_THROW(parse_orientation("inward", "", "/moving/orient"), UsageError);
}

}  // namespace
}  // namespace lmdbench
