// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/polygon.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using Corners2d = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How often an outline goes round a point.
int winding_number(const Corners2d& outline, const Eigen::Vector2d& p) {
  int turns = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y() <= p.y()) == (b.y() <= p.y())) continue;
    const double side = cross(b - a, p - a);
    turns += a.y() <= p.y() ? (side > 0.0 ? 1 : 0) : (side < 0.0 ? -1 : 0);
  }
  return turns;
}

/// Begun at each of its corners, on a plane of each axis and a tilted one, an outline is cut into
/// triangles that cover it once and nothing else, each turning as it does.
void expect_covered(const Corners2d& outline, const std::string& what) {
  std::mt19937_64 random(7);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outline) box.extend(p);
  const std::vector<Eigen::Quaterniond> turns{
      Eigen::Quaterniond::Identity(),
      Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX())),
      Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitY())),
      Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()))};
  for (std::size_t start = 0; start < outline.size(); ++start) {
    TriangleMesh mesh;
    std::vector<std::int32_t> polygon(outline.size());
    std::iota(polygon.begin(), polygon.end(), std::int32_t{0});
    std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(start), polygon.end());
    for (const Eigen::Vector2d& p : outline)
      mesh.vertices.push_back(turns[start % turns.size()] * Vec3(p.x(), p.y(), 0.0));
    const auto fault = add_polygon(polygon, mesh);
    ASSERT_FALSE(fault) << what << ", from corner " << start << ": " << fault->problem;
    ASSERT_EQ(mesh.triangles.size(), outline.size() - 2) << what << ", from corner " << start;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d p = box.sample();
      int covered = 0;
      for (const auto& [a, b, c] : mesh.triangles) {
        const Corners2d triangle{outline[static_cast<std::size_t>(a)], outline[static_cast<std::size_t>(b)],
                                 outline[static_cast<std::size_t>(c)]};
        covered += winding_number(triangle, p);
      }
      ASSERT_EQ(covered, winding_number(outline, p)) << what << ", from corner " << start;
    }
  }
}

TEST(Polygon, OutlinesThatNoFanFillsAreCoveredOnce) {
  expect_covered({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, "U");
  expect_covered({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, "L");
  expect_covered({{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 3}, {-1, 3}, {-1, 2}, {0, 2}}, "T");
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                 "U with corners along a side");
  Corners2d spiral;
  for (int i = 0; i <= 40; ++i)
    spiral.emplace_back(Eigen::Rotation2Dd(0.3 * i) * Eigen::Vector2d(1.0 + 0.1 * i, 0));
  for (int i = 40; i >= 0; --i)
    spiral.emplace_back(Eigen::Rotation2Dd(0.3 * i) * Eigen::Vector2d(0.8 + 0.1 * i, 0));
  expect_covered(spiral, "spiral");
}

/// As exporters write a face with a hole: out along a bridge and back.
TEST(Polygon, ABridgeLeadsToAHole) {
  expect_covered({{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}},
                 "one hole");
  expect_covered({{0, 0},
                  {9, 0},
                  {9, 6},
                  {0, 6},
                  {0, 2},
                  {2, 2},
                  {2, 4},
                  {4, 4},
                  {4, 2},
                  {5, 2},
                  {5, 4},
                  {7, 4},
                  {7, 2},
                  {5, 2},
                  {4, 2},
                  {2, 2},
                  {0, 2}},
                 "two holes in a row");
}

TEST(Polygon, RandomStepsAndStars) {
  std::mt19937_64 random(20261130);
  std::uniform_real_distribution<double> height(0.5, 5.0);
  for (int k = 0; k < 60; ++k) {
    Corners2d steps{{0, 0}};
    const int count = 3 + k % 8;
    for (int i = count; i-- > 0;) {
      const double level = std::round(4.0 * height(random)) / 4.0;
      if (i + 1 == count) steps.emplace_back(count, 0.0);
      if (steps.back().y() != level) steps.emplace_back(i + 1.0, level);
      steps.emplace_back(i, level);
    }
    expect_covered(steps, "steps " + std::to_string(k));
    Corners2d star;
    for (int i = 0; i < 5 + k % 20; ++i)
      star.emplace_back(Eigen::Rotation2Dd(2.0 * std::numbers::pi * i / (5 + k % 20)) *
                        Eigen::Vector2d(height(random), 0));
    expect_covered(star, "star " + std::to_string(k));
  }
}

/// A notch smaller than rounding of the area is one, and so is one beside a corner along the way.
TEST(Polygon, ASmallNotchStaysOpen) {
  TriangleMesh mesh;
  for (const Eigen::Vector2d& p :
       Corners2d{{0, 0}, {0.5, 0}, {0.5, 0.001}, {0.501, 0.001}, {0.501, 0}, {1, 0}, {1, 1}, {0, 1}})
    mesh.vertices.emplace_back(p.x(), p.y(), 0.0);
  const std::vector<std::int32_t> polygon{0, 1, 2, 3, 4, 5, 6, 7};
  ASSERT_FALSE(add_polygon(polygon, mesh));
  for (std::int32_t t = 0; t < 6; ++t) {
    const Triangle c = mesh.triangle(t);
    EXPECT_GE((c[1] - c[0]).cross(c[2] - c[0]).z(), 0.0) << t;
  }
}

TEST(Polygon, ABowTieIsAFault) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::int32_t> polygon{0, 1, 2, 3};
  EXPECT_TRUE(add_polygon(polygon, mesh));
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(Polygon, SidesThatCrossAreAFault) {
  TriangleMesh mesh;
  for (const Eigen::Vector2d& p : Corners2d{{0, 0}, {4, 0}, {1, 3}, {3, 3}, {0, 1}})
    mesh.vertices.emplace_back(p.x(), p.y(), 0.0);
  const std::vector<std::int32_t> polygon{0, 1, 2, 3, 4};
  const auto fault = add_polygon(polygon, mesh);
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->problem, HasSubstr("sides cross"));
  EXPECT_TRUE(mesh.triangles.empty());
}

}  // namespace
}  // namespace lmdbench
