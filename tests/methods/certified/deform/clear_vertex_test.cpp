// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/deform/clear_vertex.h>

#include "methods/certified/traverse/wide_samples.h"
#include <gtest/gtest.h>
#include <support/polar_cone.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using testing::shapes;

/// A fan round vertex 0; the other vertices have these heights.
Surface fan(const std::vector<double>& heights) {
  TriangleMesh mesh;
  mesh.vertices.push_back(Vec3::Zero());
  const auto count = static_cast<std::int32_t>(heights.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), heights[static_cast<std::size_t>(i)]);
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return build_surface(std::move(mesh));
}

TEST(ClearVertex, SaysWhatTheSearchSays) {
  std::size_t peaks = 0, saddles = 0, left_to_the_search = 0;
  for (const TriangleMesh& mesh : shapes()) {
    const Surface surface = build_surface(mesh);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices.size()); ++v) {
      const FeatureId feature{FeatureKind::VERTEX, v};
      const auto searched = polar_cap(surface, feature);
      const SaddleWitness witness = find_saddle_witness(surface, v);
      if (witness != NO_WITNESS) {
        EXPECT_TRUE(is_clear_saddle(surface, v, witness));
        EXPECT_FALSE(searched.has_value()) << "vertex " << v;
        ++saddles;
      }
      const auto peak = clear_peak_cap(surface, v);
      if (!peak) {
        ++left_to_the_search;
        continue;
      }
      ASSERT_TRUE(searched.has_value()) << "vertex " << v;
      EXPECT_EQ(witness, NO_WITNESS) << "vertex " << v;
      if (peak->is_all_directions()) continue;
      ++peaks;
      EXPECT_NEAR(peak->cosine, searched->cosine, 1e-4) << "vertex " << v;
      for (const Vec3& direction : testing::extreme_directions(surface, feature))
        EXPECT_GE(peak->axis.dot(direction), peak->cosine) << "vertex " << v;
    }
  }
  EXPECT_GT(peaks, 300u);
  EXPECT_GT(saddles, 300u);
  EXPECT_GT(left_to_the_search, 300u);
}

TEST(ClearVertex, SaddlesAreClearUntilTheyAreNearlyFlat) {
  const auto is_saddle = [](double height) {
    return find_saddle_witness(fan({height, 0.0, -height, 0.0, height, 0.0, -height, 0.0}), 0) != NO_WITNESS;
  };
  EXPECT_TRUE(is_saddle(0.5));
  EXPECT_TRUE(is_saddle(0.01));
  EXPECT_FALSE(is_saddle(1e-6)) << "within the slack: the search decides";
  EXPECT_FALSE(is_saddle(0.0));
  EXPECT_EQ(find_saddle_witness(fan({-1, -1, -1, -1, -1}), 0), NO_WITNESS);
}

TEST(ClearVertex, AWitnessThatNoLongerHoldsIsNone) {
  const Surface saddle = fan({1, -1, 1, -1});
  const SaddleWitness witness = find_saddle_witness(saddle, 0);
  ASSERT_NE(witness, NO_WITNESS);
  EXPECT_FALSE(is_clear_saddle(fan({-1, -1, -1, -1}), 0, witness));
  EXPECT_FALSE(is_clear_saddle(fan({1, -1, 1, 1}), 0, witness)) << "the walls of a pit";
}

TEST(ClearVertex, PitsAndPeaksWithAGrooveAreNoClearPeaks) {
  EXPECT_TRUE(clear_peak_cap(fan({-1, -1, -1, -1}), 0).has_value());
  EXPECT_FALSE(clear_peak_cap(fan({1, 1, 1, 1}), 0).has_value()) << "a pit";
  EXPECT_FALSE(clear_peak_cap(fan({-1, -1, -3, -1, -1, -1}), 0).has_value()) << "a groove";
  for (const TriangleMesh& mesh : shapes()) {
    TriangleMesh inside_out = mesh;
    for (auto& corners : inside_out.triangles) std::swap(corners[0], corners[1]);
    const Surface surface = build_surface(mesh), turned = build_surface(inside_out);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices.size()); ++v)
      EXPECT_FALSE(clear_peak_cap(surface, v) && clear_peak_cap(turned, v)) << v;
  }
}

}  // namespace
}  // namespace lmdbench
