// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/near_frame.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

namespace lmdbench {
namespace {

using testing::make_scene;

/// Coordinates are multiples of 1/8 and offsets are large powers of two: sums are exact.
const Vec3 FAR{0x1p30, -0x1p29, 0x1p30};
constexpr double BOX = 0.5;

Scene boxes(const Vec3& offset_M, const Vec3& offset_W) {
  const TriangleMesh box = make_box({BOX, BOX, BOX});
  return make_scene(translated(box, offset_M), translated(box, offset_W), 0.25);
}

TEST(NearFrame, LeavesScenesNearTheOriginAlone) {
  const Scene scene = boxes(Vec3::Zero(), Vec3(2.0, 0.0, 0.0));
  const NearFrame frame(scene);
  EXPECT_FALSE(frame.differs());
  EXPECT_EQ(frame.scene().moving, scene.moving);
  ASSERT_EQ(frame.scene().fixed.size(), scene.fixed.size());
  for (std::size_t i = 0; i < scene.fixed.size(); ++i)
    EXPECT_EQ(frame.scene().fixed[i].body, scene.fixed[i].body);
}

TEST(NearFrame, CountsFromSixteenHalfDiagonals) {
  const double half_diagonal = 0.5 * BOX * std::sqrt(3.0);
  const auto differs = [&](double halves_M, double halves_W) {
    return NearFrame(boxes({halves_M * half_diagonal, 0.0, 0.0}, {halves_W * half_diagonal, 0.0, 0.0}))
        .differs();
  };
  EXPECT_FALSE(differs(15.9, 0.0));
  EXPECT_TRUE(differs(16.1, 0.0));
  // In the world frame the sizes of both meshes count.
  EXPECT_FALSE(differs(0.0, 31.9));
  EXPECT_TRUE(differs(0.0, 32.1));
}

TEST(NearFrame, StaysWhereItIsAtRest) {
  for (const bool far_at_rest : {false, true}) {
    const Scene scene = boxes(far_at_rest ? FAR : Vec3::Zero(), Vec3::Zero());
    auto& body = const_cast<Body&>(*scene.moving);
    std::vector<Vec3> vertices = body.surface().mesh.vertices;
    for (Vec3& vertex : vertices) vertex += (far_at_rest ? -1.0 : 1.0) * FAR;
    body.deform(vertices);
    EXPECT_EQ(NearFrame(scene).differs(), far_at_rest);
    for (Vec3& vertex : vertices) vertex *= 2.0;
    body.deform(vertices);
    EXPECT_EQ(NearFrame(scene).differs(), far_at_rest);
  }
}

TEST(NearFrame, MovesMeshesPosesAndPointsThereAndBack) {
  const Scene near = boxes(Vec3::Zero(), Vec3::Zero());
  for (const bool far_M : {false, true}) {
    for (const bool far_W : {false, true}) {
      if (!far_M && !far_W) continue;
      const Vec3 offset_M = far_M ? FAR : Vec3::Zero(), offset_W = far_W ? Vec3(-FAR) : Vec3::Zero();
      const NearFrame frame(boxes(offset_M, offset_W));
      ASSERT_TRUE(frame.differs());
      EXPECT_EQ(frame.scene().moving->surface().mesh.vertices, near.moving->surface().mesh.vertices);
      EXPECT_EQ(frame.scene().fixed[0]->surface().mesh.vertices, near.fixed[0]->surface().mesh.vertices);
      EXPECT_EQ(frame.scene().cutoff, 0.25);

      // A quarter turn about z and 1 along x, for meshes at the origin.
      const Pose X_NN{Vec3(1.0, 0.0, 0.0), Eigen::Quaterniond(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5))};
      Pose X_WM = X_NN;
      X_WM.translation += offset_W - X_NN.rotation * offset_M;
      EXPECT_LE((frame.to_near(X_WM).translation - X_NN.translation).norm(), 1e-6) << "rounding at 1e9";
      EXPECT_EQ(frame.to_near(X_WM).rotation.coeffs(), X_NN.rotation.coeffs());
    }
  }
}

}  // namespace
}  // namespace lmdbench
