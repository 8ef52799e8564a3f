// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/polygon.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/area_turning_left.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
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

/// The faces of a box with corners along its edges, each begun anywhere, make a closed surface: an
/// edge of two triangles that turn one way, and none without area.
TEST(Polygon, CornersAlongSidesAreNoTrianglesOfTheirOwn) {
  constexpr std::array<std::array<std::int32_t, 4>, 6> FACES{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  std::mt19937_64 random(20261130);
  std::uniform_real_distribution<double> along(0.1, 0.9);
  for (int box = 0; box < 200; ++box) {
    const Eigen::Quaterniond turn = box % 2 == 0 ? Eigen::Quaterniond::Identity()
                                                 : Eigen::Quaterniond(Eigen::Vector4d::Random().normalized());
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(2.0 * (i & 1), (i >> 1) & 1, (i >> 2) & 1);
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> between;
    std::vector<std::vector<std::int32_t>> polygons;
    for (const auto& face : FACES) {
      std::vector<std::int32_t>& polygon = polygons.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t a = face[k], b = face[(k + 1) % 4];
        auto [edge, is_new] = between.try_emplace(std::minmax(a, b));
        for (std::uint64_t n = is_new ? random() % 3 : 0; n > 0; --n) {
          const Vec3 from = edge->second.empty() ? mesh.vertices[static_cast<std::size_t>(std::min(a, b))]
                                                 : mesh.vertices.back();
          const Vec3 to = mesh.vertices[static_cast<std::size_t>(std::max(a, b))];
          edge->second.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
          mesh.vertices.push_back(from + along(random) * (to - from));
        }
        polygon.push_back(a);
        if (a < b) polygon.insert(polygon.end(), edge->second.begin(), edge->second.end());
        if (a > b) polygon.insert(polygon.end(), edge->second.rbegin(), edge->second.rend());
      }
      std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()),
                  polygon.end());
    }
    for (Vec3& vertex : mesh.vertices) vertex = (turn * vertex).cast<float>().cast<double>();
    for (const auto& polygon : polygons) ASSERT_FALSE(add_polygon(polygon, mesh)) << box;
    std::set<std::pair<std::int32_t, std::int32_t>> sides;
    for (const auto& [a, b, c] : mesh.triangles)
      for (const auto& side : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        ASSERT_TRUE(sides.insert(side).second) << box;
    for (const auto& [a, b] : sides) ASSERT_TRUE(sides.contains({b, a})) << box;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle c = mesh.triangle(static_cast<std::int32_t>(t));
      ASSERT_GT((c[1] - c[0]).cross(c[2] - c[0]).norm(), 1e-4) << box;
    }
  }
}

TEST(Polygon, ACornerAtThePlaceOfTheOneBeforeIsLeftOut) {
  TriangleMesh mesh;
  mesh.vertices = {{6, 0, 0}, {6, -5, 0}, {11, 3, 0}, {9, 1, 0}, {6, 1, 0}, {4, 3, 0}, {6, 0, 0}};
  const std::vector<std::int32_t> polygon{0, 1, 1, 2, 3, 4, 5, 5, 6};
  ASSERT_FALSE(add_polygon(polygon, mesh));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(2.0 * testing::area_turning_left(mesh), 26.0);
  const std::vector<std::int32_t> line{0, 5, 5, 0};
  ASSERT_FALSE(add_polygon(line, mesh));
  EXPECT_EQ(mesh.triangles.size(), 4u);
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
