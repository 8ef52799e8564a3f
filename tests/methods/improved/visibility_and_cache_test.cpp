// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/improved/result_cache.h>
#include <lmdbench/methods/improved/visibility.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

ShadedTriangle flat(const Triangle& corners) {
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  return {corners, {normal, normal, normal}, normal};
}

ShadedTriangle facing_down(double x, double z) {
  return flat({Vec3(x, 0, z), Vec3(x, 1, z), Vec3(x + 1, 0, z)});
}
ShadedTriangle facing_up(double x) {
  return flat({Vec3(x, 0, 0), Vec3(x + 1, 0, 0), Vec3(x, 1, 0)});
}

TEST(Visibility, FacingTrianglesSeeEachOtherWhereTheyOverlap) {
  for (const Visibility policy : {Visibility::VERTEX_NORMAL, Visibility::ORTHOGONAL}) {
    EXPECT_TRUE(see_each_other(facing_down(0.0, 1.0), facing_up(0.2), policy));
    EXPECT_FALSE(see_each_other(facing_down(1.5, 1.0), facing_up(0.2), policy));
    EXPECT_TRUE(see_each_other(facing_down(1.2, 1.0), facing_up(0.2), policy));  // they touch
  }
  EXPECT_TRUE(see_each_other(facing_down(1.5, 1.0), facing_up(0.2), Visibility::OFF));
}

TEST(Visibility, SightTellsWhatThePreTestDecides) {
  for (const double x : {0.0, 0.7, 1.3, 5.0}) {
    const ShadedTriangle a = facing_down(x, 1.0), b = facing_up(0.2);
    EXPECT_EQ(sight(a, b).overlaps && sight(b, a).overlaps, see_each_other(a, b, Visibility::VERTEX_NORMAL))
        << x;
    ASSERT_TRUE(sight(a, b).shadow.has_value());
    EXPECT_EQ((*sight(a, b).shadow)[1], Vec3(x, 1, 0)) << "straight down";
  }
  EXPECT_FALSE(sight(facing_up(0.0), facing_up(0.0)).shadow.has_value()) << "in the plane itself";
}

TEST(Visibility, ANormalThatPointsAwayCannotCull) {
  // Back to back: no corner's normal meets the other plane, so nothing is decided (decision E6).
  ShadedTriangle away = facing_up(0.0);
  for (Vec3& corner : away.corners) corner.z() += 1.0;
  ShadedTriangle below = facing_down(5.0, 0.0);
  EXPECT_TRUE(see_each_other(away, below, Visibility::VERTEX_NORMAL));
  EXPECT_FALSE(see_each_other(away, below, Visibility::ORTHOGONAL));
}

TEST(Visibility, SpreadingVertexNormalsWidenTheShadow) {
  ShadedTriangle seer = facing_down(1.3, 1.0);
  for (std::size_t k = 0; k < 3; ++k) seer.vertex_normals[k] = Vec3(-0.5, 0.0, -1.0).normalized();
  EXPECT_FALSE(see_each_other(facing_down(1.3, 1.0), facing_up(0.2), Visibility::VERTEX_NORMAL));
  // The seer's normals are slanted enough; the seen triangle still projects straight up and misses.
  EXPECT_FALSE(see_each_other(seer, facing_up(0.2), Visibility::VERTEX_NORMAL));
  ShadedTriangle seen = facing_up(0.2);
  for (std::size_t k = 0; k < 3; ++k) seen.vertex_normals[k] = Vec3(0.5, 0.0, 1.0).normalized();
  EXPECT_TRUE(see_each_other(seer, seen, Visibility::VERTEX_NORMAL));
}

TEST(Visibility, IsSymmetric) {
  for (double x = -2.0; x < 2.0; x += 0.13)
    for (const Visibility policy : {Visibility::VERTEX_NORMAL, Visibility::ORTHOGONAL})
      EXPECT_EQ(see_each_other(facing_down(x, 0.7), facing_up(0.1), policy),
                see_each_other(facing_up(0.1), facing_down(x, 0.7), policy));
}

/// Two cubes corner to corner: all 36 triangle pairs round the two corners hold the LMD; orthogonal
/// projection culls them (decision E6). The pre-test is not conservative on coarse meshes.
TEST(Visibility, AnOrthogonalProjectionCullsTwoCornersFaceToFace) {
  const Surface surface = build_surface(make_box({1.0, 1.0, 1.0}));
  const Vec3 offset(1.1, 1.1, 1.1);
  int candidates = 0, kept = 0;
  for (std::size_t a = 0; a < 12; ++a) {
    for (std::size_t b = 0; b < 12; ++b) {
      ShadedTriangle upper = flat(surface.mesh.triangle(static_cast<std::int32_t>(a)));
      const ShadedTriangle lower = flat(surface.mesh.triangle(static_cast<std::int32_t>(b)));
      const auto touches = [](const Triangle& t, const Vec3& corner) {
        return std::any_of(t.begin(), t.end(), [&](const Vec3& p) { return p == corner; });
      };
      if (!touches(upper.corners, Vec3(-0.5, -0.5, -0.5)) || !touches(lower.corners, Vec3(0.5, 0.5, 0.5)))
        continue;
      for (Vec3& corner : upper.corners) corner += offset;
      ++candidates;
      kept += see_each_other(upper, lower, Visibility::ORTHOGONAL);
    }
  }
  EXPECT_GE(candidates, 9);
  EXPECT_EQ(kept, 0);
}

TEST(ResultCache, FindsWhatItHoldsUntilItIsErased) {
  ResultCache cache;
  for (std::int32_t i = 0; i < 5000; ++i) {
    const auto [entry, known] = cache.find_or_insert(i, 7 * i);
    EXPECT_FALSE(known);
    entry->initiator = i;
  }
  for (std::int32_t i = 0; i < 5000; ++i) {
    const auto [entry, known] = cache.find_or_insert(i, 7 * i);
    ASSERT_TRUE(known);
    EXPECT_EQ(entry->initiator, i);
  }
  EXPECT_FALSE(cache.find_or_insert(1, 0).second);
  cache.erase();
  for (std::int32_t i = 0; i < 5000; ++i) EXPECT_FALSE(cache.find_or_insert(i, 7 * i).second);
}

}  // namespace
}  // namespace lmdbench
