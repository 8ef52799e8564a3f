// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/placement.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lmdbench {
namespace {

/// Sides 1, 2 and 2, so a diagonal of 3. The centre is not the origin.
TriangleMesh box() {
  TriangleMesh mesh = make_box({1, 2, 2});
  for (Vec3& vertex : mesh.vertices) vertex += Vec3(10, 20, 30);
  mesh.planar_tolerance = 1e-3;
  return mesh;
}

Placement read(const char* text) {
  return read_placement(nlohmann::json::parse(text));
}

TEST(Placement, WithoutKeysEveryBitStays) {
  const TriangleMesh mesh = placed(box(), read("{}"));
  EXPECT_EQ(mesh.vertices, box().vertices);
  EXPECT_EQ(mesh.planar_tolerance, 1e-3);
}

TEST(Placement, ScaleIsAboutTheOriginAndScalesTheTolerance) {
  const TriangleMesh mesh = placed(box(), read(R"({"scale": 0.001})"));
  EXPECT_NEAR(bounding_box_diagonal(mesh), 0.003, 1e-15);
  EXPECT_NEAR((bounding_box_centre(mesh) - 0.001 * bounding_box_centre(box())).norm(), 0.0, 1e-15);
  EXPECT_NEAR(mesh.planar_tolerance, 1e-6, 1e-18);
}

TEST(Placement, CentreIsADiagonalsDefaultAndNobodyElses) {
  const auto centre_of = [](const char* keys) {
    return bounding_box_centre(placed(box(), read(keys))).norm();
  };
  EXPECT_NEAR(centre_of(R"({"diagonal_m": 3})"), 0.0, 1e-14);
  EXPECT_NEAR(centre_of(R"({"diagonal_m": 3, "centre": false})"), bounding_box_centre(box()).norm(), 1e-12);
  EXPECT_NEAR(centre_of(R"({"scale": 1, "centre": true})"), 0.0, 1e-14);
  EXPECT_GT(centre_of(R"({"scale": 1})"), 30.0);
}

TEST(Placement, IsWrittenAsItIsRead) {
  nlohmann::ordered_json entry;
  write_placement(read(R"({"scale": 0.5, "centre": true})"), entry);
  EXPECT_EQ(entry.dump(), R"({"scale":0.5,"centre":true})");
}

TEST(Placement, NothingHasNoDiagonalToScale) {
  EXPECT_THROW(placed(TriangleMesh{}, {.diagonal = 1.0}), InputError);
  EXPECT_THROW(refuse_extreme_size(TriangleMesh{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}, ""),
               InputError)
      << "nor a size";
}

}  // namespace
}  // namespace lmdbench
