// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <judge/rest_judge.h>

#include <algorithm>

namespace lmdbench::exact {
namespace {

LmdSet set_of(const char* method, const parts::RestScene& scene) {
  return lmds_at(*make_method(method, scene.scene), scene.X_WM);
}

std::size_t faults(const RestVerdict& verdict, RestFault fault) {
  return verdict.faults[static_cast<std::size_t>(fault)];
}

/// A box between two walls and on a floor, with different gaps in all directions.
parts::RestScene apart() {
  for (std::size_t index = 0;; ++index) {
    parts::RestScene scene = make_rest_scene(parts::rest_fit("box in channel"), 1, index);
    const auto is_apart = [&](const parts::RestPlace& place) {
      return place.demanded && place.gap >= 0.9e-6 * scene.size;
    };
    if (scene.places.size() == 3 && !scene.single_precision && std::ranges::all_of(scene.places, is_apart) &&
        scene.places[0].gap != scene.places[1].gap)
      return scene;
  }
}

/// The correct set: one pair of faces in the middle of each place.
LmdSet right_answer(const parts::RestScene& scene) {
  LmdSet lmds = set_of("exhaustive", scene);
  std::erase_if(lmds, [&](const Lmd& lmd) { return lmd.intersecting; });
  return lmds;
}

TEST(RestJudge, AcceptsWhatIsRightAndSeesEveryFault) {
  const parts::RestScene scene = apart();
  const RestTruth truth(scene);
  ASSERT_FALSE(truth.intersecting());
  const LmdSet right = right_answer(scene);
  ASSERT_EQ(right.size(), 3u) << scene.text;
  EXPECT_EQ(truth.judge(right).objections, "") << scene.text;

  LmdSet lmds(right.begin() + 1, right.end());
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::MISSING), 1u);
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::NEAREST), 1u);
  EXPECT_EQ(faults(truth.judge({}), RestFault::NEAREST), 1u);
  lmds = right;
  lmds.push_back(right.back());
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::DOUBLED), 2u) << "by its name and at its place";
  // One contact gets a direction between its own and that of another contact.
  lmds = right;
  lmds[1].direction = (right[0].direction + right[1].direction).normalized();
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::UNTRUE), 1u);
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::UNEXPECTED), 1u);
  lmds = right;
  lmds[1].distance += 10.0 * truth.tolerance();
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::UNTRUE), 1u);
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::MISSING), 1u);
  lmds = right;
  lmds[1].point_moving += 10.0 * truth.tolerance() * lmds[1].direction;
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::UNTRUE), 1u);
  // One point is moved along its plane by 1 % of a cell.
  const RestVerdict verdict = truth.judge(right);
  EXPECT_EQ(verdict.places, 3u);
  EXPECT_EQ(verdict.demanded, 3u);
  EXPECT_EQ(verdict.located, 3u);
  lmds = right;
  const Vec3 along = 0.01 * scene.size * lmds[1].direction.unitOrthogonal();
  lmds[1].point_moving += along;
  lmds[1].point_fixed += along;
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::MISPLACED), 1u);
}

TEST(RestJudge, SeesWhatIntersectingPartsInFloatsCannotHave) {
  for (std::size_t index = 0;; ++index) {
    const parts::RestScene scene = make_rest_scene(parts::rest_fit("hook over box"), 1, index);
    if (!scene.single_precision) continue;
    const RestTruth truth(scene);
    const LmdSet right = set_of("exhaustive", scene);
    const auto first = std::ranges::find_if(right, [](const Lmd& lmd) { return lmd.intersecting; });
    if (!truth.intersecting() || first == right.end()) continue;
    EXPECT_EQ(truth.judge(right).objections, "") << scene.text;
    const auto place = first - right.begin();
    LmdSet lmds = right;
    lmds[static_cast<std::size_t>(place)].direction = Vec3::UnitX();
    EXPECT_EQ(faults(truth.judge(lmds), RestFault::UNTRUE), 1u);
    lmds = right;
    lmds.push_back(*first);
    EXPECT_EQ(faults(truth.judge(lmds), RestFault::DOUBLED), 1u);
    // One more, of two triangles that are apart.
    const TriangleMesh &moving = scene.scene.moving->surface().mesh,
                       &fixed = scene.scene.fixed[0]->surface().mesh;
    for (std::int32_t t = 0;; ++t) {
      const Triangle a = RigidTransform(scene.X_WM).triangle(moving.triangle(t)), b = fixed.triangle(0);
      Eigen::AlignedBox3d on_moving, on_fixed;
      for (std::size_t i = 0; i < 3; ++i) {
        on_moving.extend(a[i]);
        on_fixed.extend(b[i]);
      }
      if (on_moving.intersects(on_fixed)) continue;
      lmds = right;
      lmds.push_back(*first);
      lmds.back().feature_moving = {FeatureKind::FACE, t};
      lmds.back().feature_fixed = {FeatureKind::FACE, 0};
      break;
    }
    EXPECT_EQ(faults(truth.judge(lmds), RestFault::UNTRUE), 1u);
    return;
  }
}

/// Poses of each fit; lmdbench-judge rest makes a table over more.
constexpr std::size_t POSES = 15;

TEST(RestJudge, FindsNothingWrongWherePartsRest) {
  std::size_t intersecting = 0, poses = 0, demanded = 0;
  for (const parts::RestFit& fit : parts::rest_fits()) {
    for (std::size_t index = 0; index < POSES; ++index) {
      const parts::RestScene scene = make_rest_scene(fit, 7, index);
      const RestTruth truth(scene);
      ++poses;
      intersecting += truth.intersecting();
      for (const parts::RestPlace& place : scene.places) demanded += place.demanded;
      for (const char* method : {"exhaustive", "certified"})
        EXPECT_EQ(truth.judge(set_of(method, scene)).objections, "") << method << ": " << scene.text;
    }
  }
  // Enough scenes do not intersect and have LMDs to judge.
  EXPECT_LT(2 * intersecting, poses);
  EXPECT_GT(demanded, poses);
}

}  // namespace
}  // namespace lmdbench::exact
