// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/decimate.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/validity.h>

#include "support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace lmdbench {
namespace {

using testing::message_of;

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(DecimateTest, ReachesItsTargetAndStaysSound) {
  const TriangleMesh mesh = make_blob(1.0, 0.3, 5);
  const ValidityReport before = check_mesh(build_surface(mesh));
  for (const std::int32_t target : {10000, 2000, 500}) {
    const Decimation result = decimate(mesh, target, "blob");
    const ValidityReport after = check_mesh(build_surface(result.mesh));
    EXPECT_NEAR(static_cast<double>(after.triangles), target, 0.01 * target);
    EXPECT_THAT(findings(after), IsEmpty());
    EXPECT_EQ(after.genus, 0);
    EXPECT_NEAR(*after.volume, *before.volume, 0.03 * *before.volume);
    EXPECT_LT(result.relative_error, 0.02);
  }
}

TEST(DecimateTest, KeepsTheBitsOfTheVerticesItKeeps) {
  const TriangleMesh mesh = translated(make_blob(1e-3, 3e-4, 4), {100, 200, 300});
  const Decimation result = decimate(mesh, 1000, "blob");
  for (const Vec3& vertex : result.mesh.vertices)
    EXPECT_NE(std::find(mesh.vertices.begin(), mesh.vertices.end(), vertex), mesh.vertices.end());
  EXPECT_THAT(findings(check_mesh(build_surface(result.mesh))), IsEmpty());
}

TEST(DecimateTest, IsTheSameEveryTime) {
  const TriangleMesh mesh = make_torus(1.0, 0.3, 64, 32);
  const Decimation first = decimate(mesh, 1000, "torus"), second = decimate(mesh, 1000, "torus");
  EXPECT_EQ(first.mesh.triangles, second.mesh.triangles);
  EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
}

TEST(DecimateTest, LeavesSmallerMeshesAlone) {
  const TriangleMesh mesh = make_box({1, 1, 1});
  EXPECT_EQ(decimate(mesh, 12, "box").mesh.triangles, mesh.triangles);
  EXPECT_EQ(decimate(mesh, 1000, "box").mesh.triangles, mesh.triangles);
}

TEST(DecimateTest, RefusesWhatItCannotReach) {
  // A torus cannot become four triangles and stay a torus.
  EXPECT_THAT(
      message_of<InputError>([] { decimate(make_torus(1.0, 0.3, 32, 16), 4, "torus"); }),
      AllOf(HasSubstr("decimation stops at"), HasSubstr("target 4"), HasSubstr("choose a larger target")));
}

}  // namespace
}  // namespace lmdbench
