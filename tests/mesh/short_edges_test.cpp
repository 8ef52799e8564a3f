// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/short_edges.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>
#include <support/rounded.h>

#include <algorithm>

namespace lmdbench {
namespace {

using testing::stepped;

TEST(ShortEdges, AWallOfRoundingCollapses) {
  TriangleMesh mesh = stepped(1e-16);
  const TriangleMesh before = mesh;
  EXPECT_EQ(collapse_short_edges(mesh, 1e-15), 4) << "of the wall and of both ends";
  EXPECT_EQ(mesh.vertices, before.vertices);
  EXPECT_EQ(mesh.triangles.size(), before.triangles.size());
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t v : corners) EXPECT_TRUE(v != 1 && v != 7) << "the lower ones come first";
  const ValidityReport report = check_mesh(build_surface(mesh));
  EXPECT_TRUE(report.closed && report.manifold && report.consistently_oriented);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.unused_vertices, 2);
  EXPECT_EQ(collapse_short_edges(mesh, 1e-15), 0);
}

TEST(ShortEdges, AreNoLongerThanTheyMay) {
  TriangleMesh mesh = stepped(1e-14);
  const TriangleMesh before = mesh;
  EXPECT_EQ(collapse_short_edges(mesh, 1e-15), 0);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

/// In a row they are one place; which vertex stays hangs on coordinates alone.
TEST(ShortEdges, ThatMeetBecomeOneVertex) {
  for (const bool reversed : {false, true}) {
    TriangleMesh fan{{{0, 0, 0}, {3e-16, 0, 0}, {6e-16, 0, 0}, {9e-16, 0, 0}, {0, 1, 0}},
                     {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}}};
    if (reversed) {
      std::ranges::reverse(fan.vertices);
      for (auto& corners : fan.triangles)
        for (std::int32_t& v : corners) v = 4 - v;
    }
    EXPECT_EQ(collapse_short_edges(fan, 4e-16), 3);
    for (const auto& corners : fan.triangles)
      for (const std::int32_t v : corners) {
        const Vec3& p = fan.vertices[static_cast<std::size_t>(v)];
        EXPECT_TRUE(p == Vec3::Zero() || p == Vec3(0, 1, 0)) << p.transpose();
      }
  }
}

}  // namespace
}  // namespace lmdbench
