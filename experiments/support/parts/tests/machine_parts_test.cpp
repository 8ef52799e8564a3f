// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>
#include <support/parts/machine_parts.h>
#include <support/parts/prism_complex.h>
#include <support/parts/recut.h>

#include <algorithm>
#include <set>
#include <string>

namespace lmdbench::parts {
namespace {

/// T-junctions: vertices inside edges, within a rounding, that are no ends of them.
std::size_t t_junctions(const Surface& surface) {
  std::size_t count = 0;
  for (const auto& ends : surface.adjacency.edges) {
    const Vec3 a = surface.mesh.vertices[static_cast<std::size_t>(ends[0])];
    const Vec3 way = surface.mesh.vertices[static_cast<std::size_t>(ends[1])] - a;
    for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
      if (static_cast<std::int32_t>(v) == ends[0] || static_cast<std::int32_t>(v) == ends[1]) continue;
      const Vec3 p = surface.mesh.vertices[v] - a;
      const double along = p.dot(way) / way.squaredNorm();
      if (along > 0.0 && along < 1.0 && (p - along * way).norm() < 1e-12) ++count;
    }
  }
  return count;
}

void expect_sound(const TriangleMesh& mesh) {
  const Surface surface = build_surface(mesh);
  const ValidityReport report = check_mesh(surface);
  EXPECT_TRUE(findings(report).empty()) << findings(report).front();
  EXPECT_TRUE(report.closed && report.manifold && report.consistently_oriented);
  EXPECT_TRUE(report.outward.value_or(false));
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(t_junctions(surface), 0u);
}

TEST(MachineParts, AreClosedManifoldsWithoutTJunctions) {
  std::set<std::string> names;
  for (const Part& part : machine_parts()) {
    SCOPED_TRACE(part.name);
    const TriangleMesh mesh = part.mesh;
    expect_sound(mesh);
    EXPECT_TRUE(names.insert(part.name).second) << "a second one of this name";
    EXPECT_GT(bounding_box_diagonal(mesh), 0.4);
    EXPECT_LT(bounding_box_diagonal(mesh), 1.8);
    EXPECT_LT(mesh.triangles.size(), 3000u) << "exhaustive has to keep up";
  }
  EXPECT_GE(names.size(), 30u);
}

TEST(MachineParts, HaveTheVolumeThatTheyAreDrawnWith) {
  const auto volume = [](const char* name) {
    return check_mesh(build_surface(machine_part(name))).volume.value_or(0.0);
  };
  EXPECT_NEAR(volume("plate"), 0.125, 1e-15);
  EXPECT_NEAR(volume("block"), 0.5 * 0.375 * 0.25, 1e-15);
  EXPECT_NEAR(volume("L bracket"), 0.5 * (0.125 + 0.875 * 0.125), 1e-15);
  EXPECT_NEAR(volume("cage"), 1.0 - 0.75 * 0.75 * (6 * 0.125 + 0.75), 1e-12);
  EXPECT_NEAR(volume("wedge"), 0.5 * 0.375 * 0.5 * 0.5, 1e-15);
}

TEST(MachineParts, RefuseAnUnknownName) {
  EXPECT_THROW(machine_part("flux capacitor"), UsageError);
}

TEST(PrismComplex, LeavesNoWallBetweenWhatIsFilled) {
  PrismComplex solid({0.0, 1.0, 3.0});
  const double lines[] = {0.0, 1.0, 2.0};
  solid.add_grid(lines, lines,
                 [](std::size_t i, std::size_t j) -> Layers { return i + j == 0 ? 0b11 : 0b01; });
  const TriangleMesh mesh = solid.mesh();
  expect_sound(mesh);
  const ValidityReport report = check_mesh(build_surface(mesh));
  EXPECT_NEAR(report.volume.value_or(0.0), 4.0 + 2.0, 1e-14);
  EXPECT_NEAR(report.area, 2 * 4.0 + 4 * 2.0 + 4 * 2.0, 1e-14);
}

TEST(Recut, IsTheSameShapeInOtherTriangles) {
  experiments::Random random(5);
  for (const Part& part : machine_parts()) {
    SCOPED_TRACE(part.name);
    const TriangleMesh mesh = part.mesh, cut = recut(mesh, random);
    expect_sound(cut);
    const ValidityReport before = check_mesh(build_surface(mesh)), after = check_mesh(build_surface(cut));
    EXPECT_GT(after.triangles, before.triangles);
    EXPECT_NEAR(after.area, before.area, 1e-13);
    EXPECT_NEAR(after.volume.value_or(0.0), before.volume.value_or(1.0), 1e-13);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_NE(mesh.vertices.front(), cut.vertices.front());
  }
}

}  // namespace
}  // namespace lmdbench::parts
