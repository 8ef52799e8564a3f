// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>

#include <benchmarks/hierarchy_build/implementation.h>
#include <gtest/gtest.h>

namespace lmdbench::experiments {
namespace {

TEST(HierarchyBuilds, AnswerRight) {
  const Surface blob = build_surface(make_blob(1.0, 0.2, 3));
  const std::vector<BuildProbe> probes = build_probes(blob.mesh, 4);
  for (const BuildImplementation& implementation : build_implementations()) {
    const auto build = implementation.make(blob);
    EXPECT_EQ(check_build(implementation, *build, probes), "") << implementation.name;
    build->clear();
    EXPECT_EQ(check_build(implementation, *build, probes), "") << implementation.name << " again";
  }
}

TEST(HierarchyBuilds, AreCheckedAgainstTheMesh) {
  const Surface blob = build_surface(make_blob(1.0, 0.2, 3));
  const Surface other = build_surface(make_blob(1.0, 0.25, 3));
  const std::vector<BuildProbe> probes = build_probes(other.mesh, 4);
  for (const BuildImplementation& implementation : build_implementations()) {
    if (implementation.name == "surface") continue;
    const auto build = implementation.make(blob);
    EXPECT_NE(check_build(implementation, *build, probes), "") << implementation.name;
  }
}

TEST(HierarchyBuilds, ProbesStandApart) {
  const TriangleMesh box = make_box(Vec3(1.0, 1.0, 1.0));
  for (const BuildProbe& probe : build_probes(box, 20)) {
    EXPECT_GT(probe.distance_from_box, 0.0);
    EXPECT_LE(probe.distance_from_box, probe.distance_from_corner);
    EXPECT_LE(probe.distance_from_corner,
              probe.distance_from_box + bounding_box_diagonal(probe.box) * (1.0 + 1e-9));
  }
}

}  // namespace
}  // namespace lmdbench::experiments
