// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/shape/flat_regions.h>
#include <lmdbench/shape/planar_tolerance.h>

#include <gtest/gtest.h>
#include <support/signed_volume.h>

#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

/// Area inside the outline.
double area_of(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

void expect_solid(const TriangleMesh& mesh, std::int64_t genus) {
  const Surface surface = build_surface(mesh);
  const ValidityReport report = check_mesh(surface);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.consistently_oriented);
  const auto euler = static_cast<std::int64_t>(mesh.vertices.size()) - surface.adjacency.edge_count() +
                     static_cast<std::int64_t>(mesh.triangles.size());
  EXPECT_EQ(euler, 2 - 2 * genus);
}

TEST(Sleeve, IsClosedAndHasItsOutlinesVolume) {
  const SleeveChoice choice{.height = 0.7, .around = 120, .layers = 3, .rings = 2};
  const Outline square = polygon_outline(4, 1.0), round = circle_outline(0.4),
                gear = gear_outline(12, 0.1, 0.0);
  const auto area = [](const Outline& outline) { return area_of(outline(120, 0.0)); };
  const TriangleMesh block = make_sleeve(square, round, choice);
  expect_solid(block, 1);
  EXPECT_EQ(block.triangles.size(), 4u * 120u * 5u);
  EXPECT_NEAR(testing::signed_volume(block), 0.7 * (4.0 - area(round)), 1e-9);
  const TriangleMesh wheel = make_sleeve(gear, nullptr, choice);
  expect_solid(wheel, 0);
  EXPECT_EQ(wheel.triangles.size(), 2u * 120u * (3u + 2u * 2u - 1u));
  EXPECT_NEAR(testing::signed_volume(wheel), 0.7 * area(gear), 1e-9);
  EXPECT_NEAR(area(square), 4.0, 1e-8) << "inradius 1";
  expect_solid(make_sleeve(polygon_outline(6, 1.0), thread_outline(0.6, 0.1, 0.2),
                           {.height = 1.0, .around = 48, .layers = 40, .rings = 1}),
               1);
}

TEST(Sleeve, HasTheFlatRegionsOfItsSides) {
  const auto regions = [](const Outline& outline, const Outline& bore, int around) {
    return FlatRegions::of(build_surface(make_sleeve(
                               outline, bore, {.height = 0.3, .around = around, .layers = 4, .rings = 3})))
        .region_count();
  };
  EXPECT_EQ(regions(polygon_outline(4, 0.37), nullptr, 20), 4 + 2);
  EXPECT_EQ(regions(polygon_outline(4, 0.37), polygon_outline(4, 0.11), 20), 8 + 2);
  EXPECT_EQ(regions(polygon_outline(6, 0.37), circle_outline(0.1), 30), 6 + 30 + 2);
}

TEST(Sleeve, DoesNotFoldTheEndsOfAGear) {
  // A face that folds back into its own plane would split into regions, and contacts with it.
  for (const int teeth : {10, 20, 30}) {
    const Outline gear = gear_outline(teeth, 0.1, 0.002);
    const SleeveChoice choice{.height = 0.2, .around = 8 * teeth, .layers = 1, .rings = 3};
    for (const Outline& bore : {Outline(), circle_outline(0.02 * teeth, gear)}) {
      const TriangleMesh mesh = make_sleeve(gear, bore, choice);
      const double radius = 0.05 * teeth;
      double area = 0.0, least = 1.0;
      for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
        const Triangle triangle = mesh.triangle(t);
        const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        if (triangle[0].z() != triangle[1].z() || triangle[0].z() != triangle[2].z()) continue;
        const double outward = triangle[0].z() > 0.0 ? normal.z() : -normal.z();
        area += 0.5 * outward;
        least = std::min(least, outward);
      }
      EXPECT_GT(least, 1e-7 * radius * radius) << teeth;
      const double bored = bore ? area_of(bore(choice.around, 0.0)) : 0.0;
      EXPECT_NEAR(area, 2.0 * (area_of(gear(choice.around, 0.0)) - bored), 1e-12) << teeth;
    }
  }
}

TEST(Sleeve, GearsOfOneModuleMeshWithoutCutting) {
  // Two involute gears roll: their flanks touch along the line of action and never cross. A point
  // of one outline may be inside the other by no more than the error of the outline's chords.
  constexpr int TEETH = 16, AROUND = 32 * 20;
  constexpr double MODULE = 0.1, DISTANCE = MODULE * TEETH;
  const std::vector<Vec2> points = gear_outline(TEETH, MODULE, 0.0)(AROUND, 0.0);
  const auto inside_by = [&](const Vec2& p) {
    double winding = 0.0, nearest = 1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[i] - p, b = points[(i + 1) % points.size()] - p, side = b - a;
      winding += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      const double t = std::clamp(-a.dot(side) / side.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (a + t * side).norm());
    }
    return std::abs(winding) > 1.0 ? nearest : -nearest;
  };
  for (const double roll : {0.0, 0.03, 0.07, 0.1}) {
    double deepest = -1.0;
    for (const Vec2& point : points) {
      // The other gear turns the other way and has a gap where this one has a tooth.
      const double angle = -roll + std::numbers::pi / TEETH;
      const Vec2 turned(std::cos(angle) * point.x() - std::sin(angle) * point.y() + DISTANCE,
                        std::sin(angle) * point.x() + std::cos(angle) * point.y());
      const Vec2 p(std::cos(roll) * turned.x() + std::sin(roll) * turned.y(),
                   -std::sin(roll) * turned.x() + std::cos(roll) * turned.y());
      deepest = std::max(deepest, inside_by(p));
    }
    EXPECT_LT(deepest, 2e-3 * MODULE) << roll;
    EXPECT_GT(deepest, -2e-2 * MODULE) << "they touch: " << roll;
  }
}

TEST(Sleeve, ThreadsAreRightHandedAndFitEachOther) {
  const Outline bolt = thread_outline(0.5, 0.1, 0.2), nut = thread_outline(0.52, 0.1, 0.2);
  for (const double z : {0.0, 0.03, 0.11}) {
    const std::vector<Vec2> inner = bolt(36, z), outer = nut(36, z), next = bolt(36, z + 0.2 / 36);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      EXPECT_NEAR(outer[i].norm() - inner[i].norm(), 0.02, 1e-8);
      EXPECT_NEAR(next[(i + 1) % 36].norm(), inner[i].norm(), 1e-8) << "the crest turns with the height";
      EXPECT_GE(inner[i].norm(), 0.4 - 1e-8);
      EXPECT_LE(inner[i].norm(), 0.5 + 1e-8);
    }
  }
}

TEST(TurnedToFloats, RoundsATurnedCopy) {
  const TriangleMesh box = make_box({1.0, 2.0, 3.0}, 2);
  const Eigen::Quaterniond turn(0.1, 0.5, -0.3, 0.8);
  const TriangleMesh floats = turned_to_floats(box, turn);
  EXPECT_GT(single_precision_tolerance(floats), 0.0);
  for (std::size_t i = 0; i < box.vertices.size(); ++i) {
    const Vec3 exact = turn.normalized() * box.vertices[i];
    EXPECT_LT((floats.vertices[i] - exact).norm(), 2.5e-7);
    EXPECT_GT((floats.vertices[i] - exact).norm(), 0.0);
  }
}

}  // namespace
}  // namespace lmdbench
