// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <study/completeness/far_scenes.h>

#include <algorithm>
#include <string>

namespace lmdbench::completeness {
namespace {

TEST(FarScenes, DependOnTheirNumbersAlone) {
  const FarScene one = make_far_scene(3, 7), same = make_far_scene(3, 7), other = make_far_scene(3, 8);
  EXPECT_EQ(one.label, same.label);
  EXPECT_EQ(one.poses.front().translation, same.poses.front().translation);
  EXPECT_NE(one.poses.front().translation, other.poses.front().translation);
}

TEST(FarScenes, AreSmallAndFarAway) {
  for (std::size_t i = 0; i < 20; ++i) {
    const FarScene far = make_far_scene(5, i);
    EXPECT_GT(far.diagonal, 0.3 * SMALLEST_FAR_SIZE);
    EXPECT_LT(far.diagonal, 3.0 * LARGEST_FAR_SIZE);
    ASSERT_EQ(far.poses.size(), FAR_POSES_A_SCENE);
    const Vec3 vertex_M = far.scene.moving->surface().mesh.vertices.front();
    const Vec3 vertex_W = far.scene.fixed[0]->surface().mesh.vertices.front();
    EXPECT_NEAR(std::max(vertex_M.norm(), vertex_W.norm()), 1.0, 1e-2);
    // The meshes are near each other, wherever they are.
    const Vec3 moved_W = far.poses.front().rotation * vertex_M + far.poses.front().translation;
    EXPECT_LT((moved_W - vertex_W).norm(), 200.0 * far.diagonal);
  }
}

/// In these scenes `certified` or `exhaustive` missed an LMD when it worked in world coordinates:
/// there the kernel takes a face for its edge, or an edge's cone seems empty.
TEST(FarScenes, AreSearchedWithoutLossWhereRoundingOnceDecided) {
  std::size_t lmds = 0;
  std::string wrong;
  for (const std::size_t index : {134u, 916u, 932u, 934u}) {
    const FarScene far = make_far_scene(4, index);
    const auto judged = judge_poses(far.scene, 1.0, {far.scene.cutoff}, far.poses,
                                    [&](const std::string& what) { wrong += far.label + ", " + what; });
    for (const Judgement& judgement : judged.front().judgements) lmds += judgement.same.true_lmds;
  }
  EXPECT_EQ(wrong, "");
  EXPECT_GT(lmds, 60u);
}

}  // namespace
}  // namespace lmdbench::completeness
