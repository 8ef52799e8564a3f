// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/triangle_distance/reference.h>
#include <gtest/gtest.h>

namespace lmdbench::experiments {
namespace {

const Triangle FLOOR = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};

TEST(ReferenceTriangleDistance, KnowsTheClosestFeatures) {
  const Triangle vertex_over_face = {Vec3(0, 0, 0.25), Vec3(1, 0, 2), Vec3(0, 1, 2)};
  EXPECT_NEAR(reference_triangle_distance(FLOOR, vertex_over_face), 0.25, 1e-12);
  EXPECT_NEAR(reference_triangle_distance(vertex_over_face, FLOOR), 0.25, 1e-12);
  // Edge against edge: along y over the floor's side y = -1, crossed at right
  // angles 0.5 above and 0.5 outside.
  const Triangle edge_over_edge = {Vec3(0, -1.5, -1), Vec3(0, -1.5, 1), Vec3(0, -3, 0)};
  EXPECT_NEAR(reference_triangle_distance(FLOOR, edge_over_edge), 0.5, 1e-12);
  const Triangle beyond_corner = {Vec3(0, 3, 0), Vec3(1, 4, 0), Vec3(-1, 4, 1)};
  EXPECT_NEAR(reference_triangle_distance(FLOOR, beyond_corner), 2.0, 1e-12);
}

TEST(ReferenceTriangleDistance, IsZeroWhereTheyPierce) {
  const Triangle piercing = {Vec3(0, 0, -1), Vec3(0.1, 0, 1), Vec3(0, 0.1, 1)};
  EXPECT_EQ(reference_triangle_distance(FLOOR, piercing), 0.0);
}

}  // namespace
}  // namespace lmdbench::experiments
