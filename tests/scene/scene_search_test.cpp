// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/scene_search.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace lmdbench {
namespace {

using testing::make_body;
using testing::moved;

/// A blob past three meshes that stand where their vertices are.
Scene three_fixed(double cutoff) {
  return {make_body("moving", make_blob(0.8, 0.2, 1)),
          {make_body("torus", make_torus(1.0, 0.4, 10, 6)),
           make_body("box", translated(make_box({0.9, 0.7, 0.5}, 2), {0.3, 1.1, 0.4})),
           make_body("sphere", translated(make_sphere(0.6, 2), {-1.2, 0.2, 0.5}))},
          cutoff};
}

TEST(SceneSearch, OfAPairIsTheMethodItself) {
  Scene scene{make_body("moving", make_sphere(0.5, 1)), {make_body("fixed", make_sphere(0.5, 1))}, 0.1};
  EXPECT_TRUE(scene.is_pair());
  const std::size_t own = method_description("certified").counters.size();
  EXPECT_EQ(dynamic_cast<SceneSearch*>(make_method("certified", scene).get()), nullptr);
  EXPECT_EQ(make_method("exhaustive", scene)->description().counters.size(),
            method_description("exhaustive").counters.size());
  Scene placed = scene, several = scene;
  placed.fixed[0].X_WF = moved(3.0, 0.0, 0.0);
  several.fixed.push_back(make_body("other", make_sphere(0.5, 1)));
  for (const Scene& other : {placed, several}) {
    EXPECT_FALSE(other.is_pair());
    EXPECT_EQ(make_method("certified", other)->description().counters.size(), own + 3);
  }
}

TEST(SceneSearch, KnowsWhatOptionsMakeOfAMethod) {
  const Scene scene = three_fixed(0.1);
  EXPECT_EQ(make_method("improved", scene)->description().trackings_after_search, 2);
  EXPECT_EQ(
      make_method("improved", scene, {{"second_tracking", false}})->description().trackings_after_search, 1);
}

TEST(SceneSearch, OfSeveralFixedMeshesUnitesTheirSetsBitForBit) {
  const Scene scene = three_fixed(0.2);
  for (const MethodDescription& description : method_descriptions()) {
    if (description.promise == Promise::NEAREST_PAIR) continue;
    const auto all = make_method(description.name, scene);
    std::vector<std::unique_ptr<Method>> each;
    for (const FixedBody& fixed : scene.fixed)
      each.push_back(make_method(description.name, {scene.moving, {fixed}, scene.cutoff}));
    LmdSet lmds, tracked, one;
    std::vector<LmdSet> of_each(each.size());
    WorkCounters ignored;
    std::size_t count = 0;
    for (int frame = 0; frame < 60; ++frame) {
      Pose pose = moved(1.4 - 0.03 * frame, 0.9 - 0.01 * frame, 0.6);
      pose.rotation = Eigen::AngleAxisd(0.02 * frame, Vec3(0.0, 0.6, 0.8));
      // With tracking, the sets of the frame before are tracked as well.
      for (const bool tracks : {true, false}) {
        if (tracks)
          all->track(pose, tracked, ignored);
        else
          all->search(pose, lmds, ignored);
        LmdSet expected;
        for (std::size_t i = 0; i < each.size(); ++i) {
          if (tracks)
            each[i]->track(pose, of_each[i], ignored);
          else
            each[i]->search(pose, of_each[i], ignored);
          for (Lmd lmd : of_each[i]) {
            lmd.fixed_body = static_cast<std::int32_t>(i);
            expected.push_back(lmd);
          }
        }
        std::sort(expected.begin(), expected.end(), lmd_less);
        const LmdSet& found = tracks ? tracked : lmds;
        testing::expect_same_lmds(found, expected, description.name);
        count += found.size();
      }
      tracked = lmds;
    }
    EXPECT_GT(count, 50u) << description.name;
  }
}

TEST(SceneSearch, ChoosesNearFramesAPair) {
  // The moving mesh is near the first mesh, far from the second: each pair has an exact frame.
  const Vec3 far(0x1p26, -0x1p25, 0x1p26);
  const TriangleMesh box = make_box({1.0, 1.0, 1.0}, 2);
  const Scene scene{make_body("moving", make_box({0.75, 0.5, 0.5}, 2)),
                    {make_body("here", box), make_body("there", translated(box, far))},
                    0.5};
  for (const char* name : {"certified", "exhaustive", "improved"}) {
    const auto method = make_method(name, scene);
    LmdSet here, there;
    WorkCounters ignored;
    Pose pose = moved(1.125, 0.25, 0.5);
    pose.rotation = Eigen::AngleAxisd(0.3, Vec3(0.0, 0.6, 0.8));
    method->search(pose, here, ignored);
    pose.translation += far;
    method->search(pose, there, ignored);
    ASSERT_FALSE(here.empty());
    ASSERT_EQ(here.size(), there.size()) << name;
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_EQ(here[i].fixed_body, 0);
      EXPECT_EQ(there[i].fixed_body, 1);
      EXPECT_EQ(here[i].distance, there[i].distance);
      EXPECT_EQ(here[i].direction, there[i].direction);
      EXPECT_LT((here[i].point_fixed + far - there[i].point_fixed).norm(), 1e-7);
    }
  }
}

TEST(SceneSearch, MakesAnewOnlyPairsThatAreNearAfterADeformation) {
  const auto soft = std::make_shared<Body>("soft", build_surface(make_sphere(0.5, 2)));
  const Scene scene{
      make_body("moving", make_sphere(0.5, 2)),
      {{soft, moved(0.0, 0.0, 0.0)}, {make_body("rigid", make_sphere(0.5, 2)), moved(4.0, 0.0, 0.0)}},
      0.2};
  for (const MethodDescription& description : method_descriptions()) {
    int made = 0;
    SceneSearch search(scene, description, [&](const Scene& of_pair) {
      ++made;
      return description.make(of_pair, complete_options(description, {}, ""));
    });
    EXPECT_EQ(made, 2) << description.name;
    std::vector<Vec3> vertices = soft->surface().mesh.vertices;
    for (Vec3& vertex : vertices) vertex *= 1.05;
    soft->deform(vertices);
    LmdSet lmds;
    WorkCounters ignored;
    search.search(moved(4.0, 1.1, 0.0), lmds, ignored);
    EXPECT_FALSE(lmds.empty()) << description.name;
    EXPECT_EQ(made, 2) << description.name << ": the pair that deformed is far";
    search.search(moved(0.0, 0.6 + vertices[0].norm(), 0.0), lmds, ignored);
    ASSERT_FALSE(lmds.empty()) << description.name;
    EXPECT_EQ(lmds[0].fixed_body, 0);
    EXPECT_NEAR(lmds[0].distance, 0.1, 0.03) << description.name;
    EXPECT_EQ(made, description.follows_deformation ? 2 : 3) << description.name;
  }
}

TEST(SceneSearch, FollowsMeshesThatDeformFarFromTheirOwnOrigin) {
  // Methods do not get the meshes but copies in near frames, which must be renewed too.
  const Vec3 far(512.0, -256.0, 1024.0);
  const auto soft = std::make_shared<Body>("soft", build_surface(translated(make_sphere(0.5, 2), far)));
  Scene scene{make_body("moving", make_sphere(0.5, 2)), {}, 0.2};
  for (const double x : {-0.1, 0.1}) scene.fixed.emplace_back(soft, moved(x - far.x(), -far.y(), -far.z()));
  const auto certified = make_method("certified", scene), truth = make_method("exhaustive", scene);
  std::size_t lmds = 0;
  for (int frame = 0; frame < 30; ++frame) {
    if (frame % 10 == 9) {
      std::vector<Vec3> vertices = soft->surface().mesh.vertices;
      for (Vec3& vertex : vertices) vertex += 0.1 * (vertex - far);
      soft->deform(vertices);
    }
    // In one frame the deforming pairs are no candidates, and their methods are given back.
    const Pose pose = moved(frame == 19 ? 50.0 : 0.0, 1.15 + 0.005 * frame, 0.1);
    const LmdSet found = lmds_at(*certified, pose), expected = lmds_at(*truth, pose);
    testing::expect_like_lmds(found, expected, 1e-12, std::to_string(frame));
    lmds += found.size();
  }
  EXPECT_GT(lmds, 30u);
}

}  // namespace
}  // namespace lmdbench
