// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/shape/polygon_sweep.h>
#include <lmdbench/shape/region_shape.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <support/rounded.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

std::vector<PolygonSide> loop(const std::vector<Vec2>& corners) {
  std::vector<PolygonSide> sides;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sides.push_back({corners[k], corners[(k + 1) % corners.size()]});
  return sides;
}

double area_of(const std::vector<ConvexPolygon>& pieces) {
  double area = 0.0;
  for (const ConvexPolygon& piece : pieces) area += piece.measure().area;
  return area;
}

/// Expects that no corner turns right by more than rounding.
void expect_convex(const std::vector<ConvexPolygon>& pieces) {
  for (const ConvexPolygon& piece : pieces) {
    const std::size_t n = piece.corners.size();
    ASSERT_GE(n, 3u);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 a = piece.corners[(k + 1) % n] - piece.corners[k];
      const Vec2 b = piece.corners[(k + 2) % n] - piece.corners[(k + 1) % n];
      EXPECT_GE(cross(a, b), -1e-8 * a.norm() * b.norm());
    }
  }
}

std::vector<Vec2> circle(double radius, int count, double turn) {
  std::vector<Vec2> corners;
  for (int k = 0; k < count; ++k) {
    const double angle = turn + 2.0 * std::numbers::pi * k / count;
    corners.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

TEST(ConvexPieces, AConvexPolygonIsOnePiece) {
  for (const double turn : {0.0, 0.3, 1.1}) {
    for (const int count : {3, 4, 7, 64}) {
      const auto corners = circle(2.0, count, turn);
      const auto pieces = convex_pieces(loop(corners), 1e-14);
      ASSERT_EQ(pieces.size(), 1u) << count << " corners turned by " << turn;
      EXPECT_EQ(pieces[0].corners.size(), static_cast<std::size_t>(count));
      EXPECT_NEAR(area_of(pieces), ConvexPolygon(corners).measure().area, 1e-12);
    }
  }
}

/// A corner lost where a side bends by 1e-10 rad took a strip as wide as a thousand roundings.
TEST(ConvexPieces, SidesThatHardlyBendKeepTheirCorners) {
  for (const double turn : {0.0, 0.3, 1.1, 1.6, 2.9, 4.4}) {
    const Eigen::Rotation2Dd rotation(turn);
    for (const double out : {3e-11, -3e-11, 1e-12, -1e-12}) {
      // The second bend is where a tolerance in an angle would add up.
      std::vector<Vec2> corners{{-1.0, 0.0}, {-0.3, -out}, {0.4, -out}, {1.0, 0.0}, {0.8, 1.0}, {-0.7, 1.1}};
      for (Vec2& x : corners) x = rotation * x;
      const auto pieces = convex_pieces(loop(corners), 1e-14);
      EXPECT_EQ(pieces.size() == 1, out > 0.0);
      for (const double x : {-0.6, -0.29, 0.05, 0.39, 0.7}) {
        const double side = x < -0.3 ? (x + 1.0) / 0.7 : x < 0.4 ? 1.0 : (1.0 - x) / 0.6;
        const auto is_held = [&](double beyond) {
          const Vec2 point = rotation * Vec2(x, -side * out - beyond);
          return std::ranges::any_of(pieces, [&](const auto& piece) { return piece.holds(point, 0.0); });
        };
        EXPECT_TRUE(is_held(-4e-14)) << "turned by " << turn << ", out by " << out << ", at " << x;
        EXPECT_FALSE(is_held(4e-14)) << "turned by " << turn << ", out by " << out << ", at " << x;
      }
    }
  }
}

/// Of a fine arc each corner is nearly on the line past it.
TEST(ConvexPieces, AFineArcKeepsItsBulge) {
  std::vector<Vec2> corners;
  for (int k = 0; k <= 2000; ++k) {
    const double x = 1e-3 * k - 1.0;
    corners.emplace_back(x, 5e-11 * (x * x - 1.0));
  }
  corners.insert(corners.end(), {{0.9, 1.0}, {-0.9, 1.1}});
  for (const double turn : {0.0, 0.3, 1.6}) {
    const Eigen::Rotation2Dd rotation(turn);
    std::vector<Vec2> turned;
    for (const Vec2& x : corners) turned.emplace_back(rotation * x);
    const auto pieces = convex_pieces(loop(turned), 1e-14);
    const auto is_held = [&](const Vec2& x) {
      return std::ranges::any_of(pieces, [&](const auto& piece) { return piece.holds(rotation * x, 0.0); });
    };
    for (double x = -0.95; x < 1.0; x += 0.1) {
      const double border = 5e-11 * (x * x - 1.0);
      EXPECT_TRUE(is_held({x, border + 1e-13})) << turn << " at " << x;
      EXPECT_FALSE(is_held({x, border - 1e-13})) << turn << " at " << x;
    }
  }
}

TEST(ConvexPieces, AHoleIsLeftOut) {
  for (const double turn : {0.0, 0.2, 0.7}) {
    std::vector<PolygonSide> sides = loop(circle(2.0, 40, turn));
    std::vector<Vec2> hole = circle(1.0, 20, 2.0 * turn);
    std::reverse(hole.begin(), hole.end());
    const auto inner = loop(hole);
    sides.insert(sides.end(), inner.begin(), inner.end());
    const auto pieces = convex_pieces(sides, 1e-14);
    expect_convex(pieces);
    EXPECT_NEAR(area_of(pieces),
                ConvexPolygon(circle(2.0, 40, 0.0)).measure().area -
                    ConvexPolygon(circle(1.0, 20, 0.0)).measure().area,
                1e-12);
    // A point of the hole is in no piece.
    for (const ConvexPolygon& piece : pieces)
      EXPECT_FALSE(piece.part_of(Vec2(-0.1, 0.05), Vec2(0.1, 0.0)).end > 0.0);
  }
}

TEST(ConvexPieces, AStarAndTwoIslands) {
  std::vector<Vec2> star;
  for (int k = 0; k < 24; ++k)
    star.push_back(circle(k % 2 == 0 ? 2.0 : 1.2, 24, 0.1)[static_cast<std::size_t>(k)]);
  std::vector<PolygonSide> sides = loop(star);
  const double one = area_of(convex_pieces(sides, 1e-14));
  EXPECT_NEAR(one, 12.0 * 2.0 * 1.2 * std::sin(std::numbers::pi / 12.0), 1e-12);
  for (const PolygonSide& side : loop(star))
    sides.push_back({side.from + Vec2(5.0, 0.3), side.to + Vec2(5.0, 0.3)});
  const auto pieces = convex_pieces(sides, 1e-14);
  expect_convex(pieces);
  EXPECT_NEAR(area_of(pieces), 2.0 * one, 1e-12);
}

TEST(ConvexPieces, TrianglesThatCross) {
  // Two of area 9 each, which share a hexagon of area 6.
  const std::vector<Vec2> up{{0.0, 0.0}, {6.0, 0.0}, {3.0, 3.0}}, down{{0.0, 2.0}, {3.0, -1.0}, {6.0, 2.0}};
  for (const double turn : {0.0, 0.3, 1.1, 2.0}) {
    std::vector<PolygonSide> sides;
    for (const auto& corners : {up, down})
      for (const PolygonSide& side : loop(corners)) {
        const Eigen::Rotation2Dd rotation(turn);
        sides.push_back({rotation * side.from, rotation * side.to});
      }
    const auto pieces = convex_pieces(sides, 1e-14);
    expect_convex(pieces);
    EXPECT_NEAR(area_of(pieces), 12.0, 1e-12) << "turned by " << turn;
  }
}

/// Parts of the overlap of polygons, the same whether both are mirrored or not.
void expect_parts(std::size_t count, const std::vector<std::vector<Vec2>>& of_a,
                  const std::vector<std::vector<Vec2>>& of_b, double tolerance) {
  const auto sides_of = [](const std::vector<std::vector<Vec2>>& loops, bool is_mirrored) {
    std::vector<PolygonSide> sides;
    for (const std::vector<Vec2>& corners : loops)
      for (const PolygonSide& side : loop(corners)) {
        const auto mirrored = [](const Vec2& x) { return Vec2(-x[0], x[1]); };
        sides.push_back(is_mirrored ? PolygonSide{mirrored(side.to), mirrored(side.from)} : side);
      }
    return sides;
  };
  for (const bool is_mirrored : {false, true})
    EXPECT_EQ(shared_parts(sides_of(of_a, is_mirrored), sides_of(of_b, is_mirrored), tolerance).size(), count)
        << (is_mirrored ? "mirrored" : "as drawn");
}

std::vector<Vec2> box(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

TEST(SharedParts, ANearlyLevelSidePassesOverWallsInOneRow) {
  // Its middle lies in a wall, in a row that is thinner than two tolerances.
  expect_parts(3, {{{0.0, 0.0}, {10.0, 0.0}, {10.0, 1.02}, {0.0, 1.0}}},
               {box(1.0, 0.5, 2.0, 2.0), box(2.2, 0.5, 4.5, 2.0), box(8.0, 0.5, 9.0, 2.0)}, 0.01);
}

TEST(SharedParts, ASideAsLevelAsTheToleranceMayCrossARow) {
  // The corners of the left tooth's top are in two rows, for another corner is just below.
  expect_parts(2, {{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.009}}, box(2.0, 0.0, 3.0, 3.0)},
               {{{-1.0, 0.5}, {4.0, 0.5}, {4.0, 2.5}, {-1.0, 2.5}, {-1.0, 0.995}}}, 0.01);
}

TEST(SharedParts, WhatIsApartByARowAsThinAsTheToleranceIsOne) {
  expect_parts(1, {box(0.0, 0.0, 1.0, 1.0), box(0.0, 1.015, 1.0, 2.0)}, {box(-1.0, -1.0, 3.0, 3.0)}, 0.01);
  expect_parts(2, {box(0.0, 0.0, 1.0, 1.0), box(0.0, 1.05, 1.0, 2.0)}, {box(-1.0, -1.0, 3.0, 3.0)}, 0.01);
  expect_parts(2, {box(0.0, 0.0, 1.0, 1.0), box(2.0, 1.015, 3.0, 2.0)}, {box(-1.0, -1.0, 4.0, 3.0)}, 0.01);
}

TEST(RegionShape, OutlinesAreTheTrianglesTogether) {
  for (TriangleMesh mesh : {make_box(Vec3(1.0, 0.6, 0.3), 5), make_l_block(1.0), make_patch(1.0, 6, 0.0)}) {
    const Surface surface = build_surface(testing::turned(std::move(mesh), 9));
    const FlatRegions regions = FlatRegions::of(surface);
    const RegionShapes shapes = region_shapes(surface, regions);
    for (std::int32_t region = 0; region < regions.region_count(); ++region) {
      const RegionShape* shape = shapes.of_region(region);
      ASSERT_NE(shape, nullptr);
      expect_convex(shape->pieces);
      double area = 0.0;
      for (const std::int32_t t : regions.region_triangles[region]) {
        const Triangle corners = surface.mesh.triangle(t);
        area += 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
        // The grid finds every triangle from its own middle.
        const Vec2 middle = shape->frame.flat((corners[0] + corners[1] + corners[2]) / 3.0);
        int found = 0;
        Box2 box;
        box.add(middle);
        shape->triangle_grid.for_each_near(box, 0.0, [&](std::int32_t k) {
          found += regions.region_triangles[region][static_cast<std::size_t>(k)] == t ? 1 : 0;
          return true;
        });
        EXPECT_EQ(found, 1);
      }
      EXPECT_NEAR(area_of(shape->pieces), area, 1e-13);
      EXPECT_LE(shape->pieces.size(), 3u);
    }
  }
}

/// A fan of more than a full turn, whose last triangle lies on the first: they share 1.6 of 32.
TEST(RegionShape, PartsThatOverlapAreOnce) {
  TriangleMesh fan;
  fan.vertices = {{0.0, 0.0, 0.0},   {4.0, 0.0, 0.0},  {4.0, 4.0, 0.0}, {-1.0, 3.0, 0.0},
                  {-3.0, -1.0, 0.0}, {3.0, -2.0, 0.0}, {5.0, 1.0, 0.0}};
  fan.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}};
  for (const std::uint64_t seed : {0, 9, 10}) {
    const Surface surface = build_surface(seed == 0 ? fan : testing::turned(fan, seed));
    const FlatRegions regions = FlatRegions::of(surface);
    ASSERT_EQ(regions.region_count(), 1);
    const RegionShapes shapes = region_shapes(surface, regions);
    const RegionShape& shape = *shapes.of_region(0);
    EXPECT_TRUE(shape.has_features_inside);
    expect_convex(shape.pieces);
    EXPECT_NEAR(area_of(shape.pieces), 30.4, 1e-12);
    for (const double turn : {0.0, 0.4, 1.9}) {
      const auto parts = shared_parts(shape.sides, loop(circle(40.0, 4, turn)), 1e-14);
      ASSERT_EQ(parts.size(), 1u);
      EXPECT_NEAR(area_of(parts.front()), 30.4, 1e-10);
    }
  }
}

}  // namespace
}  // namespace lmdbench
