// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/validity.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ValidityReport report_of(const TriangleMesh& mesh) {
  return check_mesh(build_surface(mesh));
}

TEST(ValidityTest, SoundSolidsHaveNoFindings) {
  for (const TriangleMesh& mesh :
       {make_sphere(1, 2), make_box({1, 2, 3}, 2), make_torus(1, 0.3, 16, 8), make_blob(1, 0.3, 2),
        make_needles(1, 4, 50), make_l_block(1), make_wedge(1, 1, 1)}) {
    const ValidityReport report = report_of(mesh);
    EXPECT_TRUE(report.closed && report.manifold && report.consistently_oriented);
    EXPECT_EQ(report.outward, true);
    EXPECT_EQ(report.components, 1);
    EXPECT_THAT(findings(report), IsEmpty());
  }
}

TEST(ValidityTest, MeasuresABox) {
  const ValidityReport report = report_of(translated(make_box({1, 2, 3}), {1000, 0, 0}));
  EXPECT_EQ(report.vertices, 8);
  EXPECT_EQ(report.edges, 18);
  EXPECT_EQ(report.triangles, 12);
  EXPECT_NEAR(report.area, 22.0, 1e-9);
  EXPECT_NEAR(*report.volume, 6.0, 1e-9);
  EXPECT_NEAR(report.diagonal, std::sqrt(14.0), 1e-9);
  EXPECT_NEAR(report.shortest_edge, 1.0, 1e-9);
  EXPECT_NEAR(report.longest_edge, std::sqrt(13.0), 1e-9);
  EXPECT_NEAR(report.worst_aspect, 10.0 / 3.0, 1e-9)
      << "the 1 by 3 sides: diagonal squared over twice the area";
}

TEST(ValidityTest, GenusIsSummedOverComponents) {
  EXPECT_EQ(report_of(make_sphere(1, 1)).genus, 0);
  EXPECT_EQ(report_of(make_torus(1, 0.3, 12, 8)).genus, 1);
  const ValidityReport three =
      report_of(merged(merged(make_torus(1, 0.3, 12, 8), translated(make_torus(1, 0.3, 12, 8), {5, 0, 0})),
                       translated(make_sphere(1, 1), {10, 0, 0})));
  EXPECT_EQ(three.components, 3);
  EXPECT_EQ(three.genus, 2);
}

TEST(ValidityTest, OpenMeshesHaveLoopsAndNoVolume) {
  TriangleMesh box = make_box({1, 1, 1}, 4);
  box.triangles.erase(box.triangles.begin());
  box.triangles.pop_back();
  const ValidityReport report = report_of(box);
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.boundary_edges, 6);
  EXPECT_EQ(report.boundary_loops, 2);
  EXPECT_FALSE(report.volume || report.outward || report.genus);
  EXPECT_THAT(findings(report), ElementsAre(HasSubstr("6 boundary edges in 2 loops")));
}

TEST(ValidityTest, SeesWhatIsInsideOut) {
  TriangleMesh box = make_box({1, 1, 1});
  for (auto& corners : box.triangles) std::swap(corners[0], corners[1]);
  const ValidityReport report = report_of(box);
  EXPECT_EQ(report.outward, false);
  EXPECT_THAT(findings(report), ElementsAre(HasSubstr("inside out")));
}

TEST(ValidityTest, SeesPiecesThatAreInsideOut) {
  TriangleMesh turned = make_box({1, 1, 1});
  for (auto& corners : turned.triangles) std::swap(corners[0], corners[1]);
  const TriangleMesh large = make_box({3, 3, 3});
  for (const auto& mesh :
       {merged(large, translated(turned, {5, 0, 0})), merged(large, make_box({1, 1, 1}))}) {
    const ValidityReport report = report_of(mesh);
    EXPECT_EQ(report.outward, false);
    EXPECT_EQ(report.inward_triangles, 12);
    EXPECT_THAT(findings(report), ElementsAre(HasSubstr("inside out: the normals of 12 of 24 triangles")));
  }
  EXPECT_EQ(report_of(merged(large, turned)).outward, true) << "a cavity";
  turned.triangles.pop_back();
  const ValidityReport open = report_of(turned);
  EXPECT_EQ(open.outward, false);
  EXPECT_THAT(findings(open), ElementsAre(HasSubstr("inside out"), HasSubstr("open")));
}

TEST(ValidityTest, WhatHasNoVolumeHasNoOuterSide) {
  const double c = std::sqrt(0.5);  // tilted: the volume is rounding
  for (const auto& corners : {std::array<Vec3, 3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                              {{{0.1, 0.2, 0.3}, {0.7, 0.2 + c, 0.9}, {1.1 * c, 2.3, -0.3 * c}}}}) {
    const TriangleMesh sheet{{corners.begin(), corners.end()}, {{0, 1, 2}, {0, 2, 1}}};
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(10, 20, 30)}) {
      const ValidityReport report = report_of(translated(sheet, offset));
      EXPECT_TRUE(report.closed);
      EXPECT_EQ(report.outward, std::nullopt);
    }
  }
}

TEST(ValidityTest, SeesOneTurnedTriangle) {
  TriangleMesh box = make_box({1, 1, 1});
  std::swap(box.triangles[3][0], box.triangles[3][1]);
  const ValidityReport report = report_of(box);
  EXPECT_FALSE(report.consistently_oriented);
  EXPECT_EQ(report.misoriented_edges, 3);
  EXPECT_TRUE(report.manifold);
  EXPECT_FALSE(report.outward);
}

TEST(ValidityTest, SeesNonManifoldEdgesAndVertices) {
  TriangleMesh mesh = make_box({2, 2, 2});
  mesh.vertices.emplace_back(5, 5, 5);
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 8});
  const ValidityReport fin = report_of(mesh);
  EXPECT_EQ(fin.non_manifold_edges, 1);
  EXPECT_FALSE(fin.manifold);

  TriangleMesh touching = merged(make_box({2, 2, 2}), translated(make_box({2, 2, 2}), {2, 2, 2}));
  std::int32_t shared = 0;
  for (std::int32_t v = 0; v < 8; ++v)
    if (touching.vertices[static_cast<std::size_t>(v)] == Vec3(1, 1, 1)) shared = v;
  for (auto& corners : touching.triangles)
    for (std::int32_t& corner : corners)
      if (touching.vertices[static_cast<std::size_t>(corner)] == Vec3(1, 1, 1)) corner = shared;
  const ValidityReport bow_tie = report_of(touching);
  EXPECT_EQ(bow_tie.non_manifold_vertices, 1);
  EXPECT_EQ(bow_tie.non_manifold_edges, 0);
  EXPECT_EQ(bow_tie.components, 1);
  EXPECT_EQ(bow_tie.unused_vertices, 1);
  EXPECT_FALSE(bow_tie.genus);
}

TEST(ValidityTest, CountsDegenerateAndDuplicateTriangles) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}},
                          {{0, 1, 3}, {3, 0, 1}, {1, 0, 3}, {0, 1, 2}, {1, 1, 3}}};
  const ValidityReport report = report_of(mesh);
  EXPECT_EQ(report.duplicate_triangles, 2);
  EXPECT_EQ(report.degenerate_triangles, 2);
  EXPECT_NEAR(report.worst_aspect, 2.0, 1e-12) << "triangles without area have none";
}

TEST(ValidityTest, AnEmptyMeshIsReportedNotRefused) {
  const ValidityReport report = report_of({});
  EXPECT_EQ(report.triangles, 0);
  EXPECT_FALSE(report.closed);
}

TEST(ValidityTest, JsonAndTextTellTheSame) {
  const ValidityReport report = report_of(make_patch(1.0, 4, 0.1));
  const auto json = to_json(report);
  EXPECT_EQ(json["triangles"], 32);
  EXPECT_EQ(json["closed"], false);
  EXPECT_EQ(json["boundary_loops"], 1);
  EXPECT_TRUE(json["volume"].is_null());
  EXPECT_TRUE(json["genus"].is_null());
  EXPECT_EQ(json["findings"].size(), 1u);
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("triangles     32"));
  EXPECT_THAT(text, HasSubstr("open"));
  EXPECT_THAT(text, HasSubstr("16 boundary edges in 1 loop"));
}

}  // namespace
}  // namespace lmdbench
