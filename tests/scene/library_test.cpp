// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmdbench.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/lmd_text.h>
#include <support/message_of.h>
#include <support/scenes.h>

#include <limits>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::moved;
using testing::text;

TEST(LibraryInstances, AreCopiesOfOneMeshAtTheirPoses) {
  const PreparedMesh ball(make_sphere(0.5, 2));
  std::vector<Pose> poses;
  for (int k = 0; k < 100; ++k) poses.push_back(moved(3.0 * k, 0.0, 0.0));
  LmdSearch search(ball, std::vector<PreparedMesh>(100, ball), poses, 0.1);
  for (const int k : {0, 42, 99}) {
    const LmdSet lmds = search.at(moved(3.0 * k, 1.05, 0.0));
    ASSERT_FALSE(lmds.empty());
    EXPECT_EQ(lmds[0].fixed_body, k);
    EXPECT_NEAR(lmds[0].distance, 0.05, 0.01);
    EXPECT_NEAR(lmds[0].point_fixed.x(), 3.0 * k, 0.1);
  }
  EXPECT_TRUE(search.at(moved(1.5, 5.0, 0.0)).empty());
}

/// Of single precision, as other programs keep quaternions: else faces were tilted to edges.
TEST(LibraryPoses, AreTurnedByAQuaternionOfUnitLength) {
  const PreparedMesh cube(make_box({1, 1, 1}));
  LmdSearch search(cube, cube, 0.1);
  const double half = static_cast<double>(0.70710678F);
  Pose rounded, exact;
  rounded.rotation = {half, half, 0.0, 0.0};
  rounded.translation = exact.translation = Vec3(0.1, 0.2, 1.05);
  exact.rotation = rounded.rotation.normalized();
  const LmdSet lmds = search.at(rounded), expected = search.at(exact);
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].point_moving, expected.at(0).point_moving);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::FACE);
  EXPECT_NEAR(lmds[0].distance, 0.05, 1e-12);
}

TEST(LibraryInstances, RefusesWhatIsNoPose) {
  const PreparedMesh ball(make_sphere(0.5, 1));
  const auto made_with = [&](const std::vector<Pose>& poses) {
    return message_of<UsageError>([&] { LmdSearch(ball, std::vector<PreparedMesh>(2, ball), poses, 0.1); });
  };
  EXPECT_THAT(made_with({Pose{}}), HasSubstr("1 poses of 2"));
  Pose scaled, lost;
  scaled.rotation.coeffs() *= 2.0;
  lost.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(made_with({Pose{}, scaled}), HasSubstr("X_WF 1"));
  EXPECT_THAT(made_with({lost, Pose{}}), HasSubstr("X_WF 0"));
}

/// As of a part of a mesh that keeps the array of the whole.
TEST(LibraryMeshes, VerticesWithoutTrianglesCountForNothing) {
  TriangleMesh plate = make_patch(1.1, 12, 5e-4);
  for (Vec3& vertex : plate.vertices) vertex = vertex.cast<float>().cast<double>();
  TriangleMesh more = plate;
  more.vertices.emplace_back(1e4, 0.1, 0.0);
  const auto found = [&](const TriangleMesh& mesh, const std::string& tolerance) {
    const PreparedMesh fixed(mesh, tolerance), ball(make_sphere(0.5, 2));
    return LmdSearch(ball, fixed, 0.2).at(moved(0.0, 0.0, 0.55));
  };
  for (const std::string tolerance : {"auto", "off", "0.001%"}) {
    const LmdSet expected = found(plate, tolerance), lmds = found(more, tolerance);
    ASSERT_FALSE(expected.empty());
    EXPECT_EQ(text(lmds), text(expected)) << tolerance;
  }
}

TEST(LibraryMeshes, RefusesAToleranceThatIsNoLength) {
  for (const double tolerance :
       {std::numeric_limits<double>::quiet_NaN(), -1e-9, std::numeric_limits<double>::infinity()}) {
    TriangleMesh box = make_box({1, 1, 1});
    box.planar_tolerance = tolerance;
    EXPECT_THAT(message_of<InputError>([&] { PreparedMesh mesh(box, "auto", "peg"); }),
                HasSubstr("peg: planar_tolerance"));
  }
}

TEST(LibrarySearch, OptionsAreReadAsTheProgramReadsThem) {
  const PreparedMesh cube(make_box({1, 1, 1}));
  const auto said = [&](const std::string& options) {
    return message_of<UsageError>([&] { LmdSearch(cube, cube, 0.1, "certified", options); });
  };
  EXPECT_THAT(said(R"({"frame_coherence": true, "frame_coherence": false})"), HasSubstr("frame_coherence"));
  EXPECT_THAT(said("{\"frame_coherence\":" + std::string(100000, '[') + std::string(100000, ']') + "}"),
              HasSubstr("options"));
}

}  // namespace
}  // namespace lmdbench
