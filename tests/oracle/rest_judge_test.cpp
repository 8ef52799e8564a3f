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
  EXPECT_EQ(faults(truth.judge(lmds), RestFault::DOUBLED), 1u);
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
