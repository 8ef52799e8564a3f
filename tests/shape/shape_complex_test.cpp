// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/shape/shape_complex.h>

#include <gtest/gtest.h>
#include <support/rounded.h>
#include <support/sheets.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lmdbench {
namespace {

std::vector<Vec3> corner_wings(const Surface& surface, const ShapeComplex& shape, std::int32_t vertex) {
  std::vector<Vec3> wings;
  shape.for_each_corner_wing(surface, vertex, [&](const Vec3& w) {
    wings.push_back(w);
    return true;
  });
  return wings;
}
std::vector<Vec3> chain_wings(const Surface& surface, const ShapeComplex& shape, std::int32_t chain) {
  std::vector<Vec3> wings;
  shape.for_each_chain_wing(surface, chain, [&](const Vec3& w) {
    wings.push_back(w);
    return true;
  });
  return wings;
}

bool hold_the_same(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const auto holds = [](const std::vector<Vec3>& set, const Vec3& x) {
    return std::ranges::any_of(set, [&](const Vec3& y) { return (x - y).norm() < 1e-12; });
  };
  return std::ranges::all_of(a, [&](const Vec3& x) { return holds(b, x); }) &&
         std::ranges::all_of(b, [&](const Vec3& x) { return holds(a, x); });
}

TEST(ShapeComplex, ABoxHasTheSameWingsHoweverItsFacesAreCut) {
  for (const Pose& pose : {Pose{}, testing::pose_of_seed(2)}) {
    const auto of_cells = [&](int cells) {
      return build_surface(testing::placed(make_box({1.0, 0.5, 0.25}, cells), pose));
    };
    const Surface whole = of_cells(1);
    const ShapeComplex shape = ShapeComplex::of(whole);
    for (const int cells : {2, 3, 6}) {
      const Surface cut = of_cells(cells);
      const ShapeComplex other = ShapeComplex::of(cut);
      int corners = 0;
      for (std::int32_t v = 0; v < static_cast<std::int32_t>(cut.mesh.vertices.size()); ++v) {
        if (!other.is_corner(v)) continue;
        ++corners;
        for (std::int32_t w = 0; w < 8; ++w)
          if ((whole.mesh.vertices[static_cast<std::size_t>(w)] -
               cut.mesh.vertices[static_cast<std::size_t>(v)])
                  .norm() < 1e-9) {
            EXPECT_TRUE(hold_the_same(corner_wings(cut, other, v), corner_wings(whole, shape, w)));
          }
        EXPECT_EQ(corner_wings(cut, other, v).size(), 3u);
      }
      EXPECT_EQ(corners, 8);
      const auto middle = [](const Surface& surface, const ShapeComplex& of, std::int32_t chain) {
        const auto& ends = of.ends_of_chain(chain);
        return Vec3(0.5 * (surface.mesh.vertices[static_cast<std::size_t>(ends[0])] +
                           surface.mesh.vertices[static_cast<std::size_t>(ends[1])]));
      };
      ASSERT_EQ(other.regions.straight_edges.size(), 12u);
      for (std::int32_t c = 0; c < 12; ++c) {
        int partners = 0;
        for (std::int32_t d = 0; d < 12; ++d) {
          if ((middle(cut, other, c) - middle(whole, shape, d)).norm() > 1e-9) continue;
          ++partners;
          EXPECT_TRUE(hold_the_same(chain_wings(cut, other, c), chain_wings(whole, shape, d)));
        }
        EXPECT_EQ(partners, 1);
      }
    }
  }
}

TEST(ShapeComplex, TheInnerCornerOfAnLHasAWingInsideIt) {
  // An open sheet: without a wing along its inside, the inner corner has a quarter of a cone.
  for (const double size : {0.5, 0.125}) {
    const Surface surface = build_surface(testing::sheet_of({"#.", "##"}, size));
    const ShapeComplex shape = ShapeComplex::of(surface);
    ASSERT_EQ(shape.regions.region_count(), 1);
    ASSERT_EQ(shape.regions.straight_edges.size(), 6u);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.mesh.vertices.size()); ++v) {
      if (surface.mesh.vertices[static_cast<std::size_t>(v)].norm() > 1e-12) continue;
      ASSERT_TRUE(shape.is_corner(v));
      const auto wings = corner_wings(surface, shape, v);
      // For the direction outwards, between the two chains, some wing says no.
      const Vec3 outwards = Vec3(1.0, 1.0, 0.0).normalized();
      EXPECT_TRUE(std::ranges::any_of(wings, [&](const Vec3& w) { return w.dot(outwards) > 0.1 * size; }));
      EXPECT_TRUE(std::ranges::any_of(wings, [&](const Vec3& w) { return w.dot(outwards) < -0.1 * size; }));
    }
  }
}

TEST(ShapeComplex, AReflexCornerCutIntoACapHasAWingIntoIt) {
  // 225 degrees at the origin, half a turn of which is one triangle, beside a step of 1e-7 m: its
  // sides say no more of the direction between them than 1e-7 of their length.
  constexpr double STEP = 1e-7;
  const Surface surface = build_surface({{Vec3(0.0, 0.0, 0.0), Vec3(-STEP, -STEP, 0.0), Vec3(-0.1, -1.0, 0.0),
                                          Vec3(0.0, -1.0, 0.0), Vec3(STEP, 0.25, 0.0)},
                                         {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}});
  const ShapeComplex shape = ShapeComplex::of(surface);
  ASSERT_EQ(shape.regions.region_count(), 1);
  ASSERT_TRUE(shape.is_corner(0));
  const auto wings = corner_wings(surface, shape, 0);
  EXPECT_EQ(wings.size(), 5u);
  for (double angle = -0.75 * std::numbers::pi; angle < 0.5 * std::numbers::pi; angle += 0.01) {
    const Vec3 into(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_TRUE(std::ranges::any_of(wings, [&](const Vec3& w) { return w.dot(into) > 0.7 * STEP; })) << angle;
  }
}

TEST(ShapeComplex, LeadsAreTheLowestAndCarriersTheRegionsThatHoldAFeature) {
  const Surface surface = build_surface(make_l_block(1.0));
  const ShapeComplex shape = ShapeComplex::of(surface);
  EXPECT_TRUE(shape.is_joined);
  int leads = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface.mesh.triangles.size()); ++t) {
    leads += shape.is_lead({FeatureKind::FACE, t}) ? 1 : 0;
    EXPECT_LE(shape.lead_of_region(shape.region_of(t)), t);
  }
  EXPECT_EQ(leads, 8);
  std::vector<std::int32_t> carriers;
  for (std::int32_t c = 0; c < 18; ++c) {
    carriers.clear();
    shape.append_carriers(surface, {FeatureKind::EDGE, c}, carriers);
    EXPECT_EQ(carriers.size(), 2u);
    EXPECT_TRUE(shape.is_lead({FeatureKind::EDGE, shape.lead_of_chain(c)}));
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.mesh.vertices.size()); ++v) {
    if (!shape.is_corner(v)) continue;
    carriers.clear();
    shape.append_carriers(surface, {FeatureKind::VERTEX, v}, carriers);
    EXPECT_EQ(carriers.size(), 3u);
  }
}

TEST(ShapeComplex, NamesTheFirstFaceAtAPoint) {
  const Surface surface = build_surface(make_box(Vec3(1.0, 1.0, 1.0), 3));
  const ShapeComplex shape = ShapeComplex::of(surface);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface.mesh.triangles.size()); ++t) {
    const Triangle corners = surface.mesh.triangle(t);
    const std::int32_t region = shape.region_of(t);
    EXPECT_EQ(shape.face_at(surface, region, (corners[0] + corners[1] + corners[2]) / 3.0), t);
    // At a corner several faces meet: the first one counts, whatever the rounding.
    const std::int32_t at_corner = shape.face_at(surface, region, corners[1]);
    EXPECT_LE(at_corner, t);
    EXPECT_EQ(shape.face_at(surface, region, corners[1] + Vec3(1e-13, -1e-13, 1e-13)), at_corner);
  }
  EXPECT_EQ(shape.face_at(surface, 2, Vec3(9.0, 9.0, 9.0)), shape.lead_of_region(2));
}

TEST(ShapeComplex, TrianglesThatAddNothingHaveNoFeatures) {
  for (const TriangleMesh& clean : {make_blob(0.5, 0.1, 2), make_box({1.0, 1.0, 1.0}, 3)}) {
    const Surface sound = build_surface(clean), flawed = build_surface(with_zero_areas(clean, 3));
    const ShapeComplex other = ShapeComplex::of(flawed);
    ASSERT_GT(flawed.mesh.triangles.size(), sound.mesh.triangles.size() + 50);
    for (std::size_t v = sound.mesh.vertices.size(); v < flawed.mesh.vertices.size(); ++v)
      EXPECT_FALSE(other.is_corner(static_cast<std::int32_t>(v))) << v;
    for (std::size_t e = 0; e < flawed.adjacency.edges.size(); ++e) {
      const auto& triangles = flawed.adjacency.edge_triangles[static_cast<std::int32_t>(e)];
      if (std::ranges::none_of(triangles, [&](std::int32_t t) { return other.region_of(t) >= 0; })) {
        EXPECT_LT(other.chain_of(static_cast<std::int32_t>(e)), 0) << e;
      }
    }
  }
}

TEST(ShapeComplex, ATriangleWithoutAreaThatOthersHangOnIsCarriedByItself) {
  // A square whose lower half has a vertex inside the diagonal; a triangle of both closes the seam.
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                          {{0, 2, 3}, {0, 1, 4}, {1, 2, 4}, {0, 4, 2}}};
  const Surface surface = build_surface(mesh);
  const ShapeComplex shape = ShapeComplex::of(surface);
  ASSERT_TRUE(shape.regions.adds_nothing.empty() || !shape.regions.adds_nothing[3]);
  EXPECT_TRUE(shape.is_corner(4));
  std::vector<std::int32_t> of_half;
  for (std::int32_t k = 0; k < 3; ++k) {
    const std::int32_t chain =
        shape.chain_of(surface.adjacency.triangle_edges[3][static_cast<std::size_t>(k)]);
    ASSERT_GE(chain, 0);
    of_half.clear();
    shape.append_carriers(surface, {FeatureKind::EDGE, chain}, of_half);
    EXPECT_EQ(std::ranges::count(of_half, -1 - 3), 1);
  }
}

}  // namespace
}  // namespace lmdbench
