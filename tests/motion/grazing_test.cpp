// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/mesh_scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace lmdbench {
namespace {

/// Meshes of similar and different sizes, far from their origins.
PathScene scene(double moving_diagonal, double fixed_diagonal) {
  TriangleMesh moving = scaled_to_diagonal(make_box({1, 2, 2}), moving_diagonal);
  for (Vec3& vertex : moving.vertices) vertex += Vec3(0.3, 0.1, 0);
  return mesh_scene(std::move(moving), scaled_to_diagonal(make_torus(1.0, 0.4, 24, 12), fixed_diagonal));
}

TEST(Grazing, EveryHapticFrameStaysOutsideAndSomeAreNear) {
  for (const auto& [moving, fixed] : {std::pair(0.1, 0.15), std::pair(0.01, 0.15), std::pair(0.15, 0.02)}) {
    const PathScene pair = scene(moving, fixed);
    const double cutoff = 0.02 * std::min(moving, fixed);
    const GrazingPath made = grazing_path(pair, cutoff, 1000.0);
    const GapMeasure gaps = measure_gaps(resample(PathInterpolator(made.path), 1000.0), pair.distance);
    EXPECT_GE(gaps.smallest(), GRAZING_FLOOR_IN_CUTOFFS * cutoff) << moving;
    EXPECT_LE(gaps.smallest(), 0.5 * cutoff) << moving;
    EXPECT_EQ(gaps.smallest(), made.smallest_gap);
    EXPECT_GT(gaps.gaps.front(), cutoff) << "begins out of contact";
    EXPECT_GT(gaps.gaps.back(), cutoff);
    EXPECT_GT(gaps.frames_within(cutoff), gaps.gaps.size() / 4) << moving;
  }
}

TEST(Grazing, ItsProgressNeverGoesBack) {
  std::vector<std::size_t> shown;
  std::set<std::size_t> totals;
  int paths = 0;
  rich_grazing_path(
      scene(0.1, 0.15), 0.002, 1000.0, [&paths](const Path&) { return ++paths < 2 ? 1.0 : RICH_CONTACTS; },
      [&](std::size_t done, std::size_t all) {
        shown.push_back(done);
        totals.insert(all);
      });
  EXPECT_EQ(paths, 2);
  EXPECT_EQ(totals.size(), 1u);
  EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end()));
  EXPECT_LE(shown.back(), *totals.begin());
  EXPECT_GE(shown.back(), *totals.begin() / GRAZING_SEEDS);
}

TEST(Grazing, ItsSpecificationReadsBackAndMakesTheSamePath) {
  const PathScene pair = scene(0.1, 0.15);
  GrazingPath made = grazing_path(pair, 0.002, 1000.0);
  made.spec.moving = {.mesh = "box.off", .placement = {.scale = 0.001}};
  made.spec.fixed = {.mesh = "torus", .placement = {.centre = true}};
  const PathSpec spec = parse_path_spec(path_spec_text(made.spec), "spec.json");
  EXPECT_EQ(spec.moving.placement.scale, 0.001);
  EXPECT_EQ(spec.fixed.placement.centre, true);
  const Path again = generate_path(spec, pair);
  ASSERT_EQ(again.size(), made.path.size());
  for (std::size_t k = 0; k < again.size(); ++k)
    EXPECT_EQ(again[k].pose.translation, made.path[k].pose.translation) << k;
}

TEST(Grazing, MeshesThatCannotMeetAreRefused) {
  PathScene never = scene(0.1, 0.15);
  never.distance = [](const Pose&) { return 0.0; };  // they intersect wherever they are
  const auto within = [](std::size_t done, std::size_t all) { EXPECT_LE(done, all); };
  EXPECT_THROW(grazing_path(never, 0.002, 1000.0, within), InputError);
}

}  // namespace
}  // namespace lmdbench
