// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/box_grid.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::uniform;

Vec2 random_point(std::mt19937_64& random) {
  return {uniform(random), uniform(random)};
}

/// Boxes of one of several kinds.
std::vector<Box2> random_boxes(std::mt19937_64& random, int habit) {
  std::vector<Box2> boxes(1 + random() % 60);
  for (Box2& box : boxes) {
    Vec2 corner = random_point(random), size = 0.2 * random_point(random);
    if (habit == 1) size *= random() % 8 == 0 ? 5.0 : 0.01;    // A few large, many small.
    if (habit == 2) corner[1] = size[1] = 0.0;                 // On a line along x,
    if (habit == 3) corner[0] = size[0] = 0.0;                 // along y,
    if (habit == 4) corner = Vec2(0.5, 0.25), size.setZero();  // in one point,
    if (habit == 5) corner[1] *= 1e-9, size[1] *= 1e-9;        // nearly on a line.
    if (habit == 6) {                                          // Sides coincide with rows of cells.
      corner = 0.125 * (8.0 * corner).array().floor().matrix();
      size.setConstant(0.125);
    }
    box.add(corner);
    box.add(corner + size);
  }
  return boxes;
}

TEST(BoxGrid, ListsEveryBoxThatComesWithinReachOfABoxOnce) {
  std::mt19937_64 random(1);
  std::size_t near = 0, all = 0;
  for (int i = 0; i < 700; ++i) {
    const std::vector<Box2> boxes = random_boxes(random, i % 7);
    const BoxGrid grid(boxes);
    for (int k = 0; k < 20; ++k) {
      Box2 query;
      // Some points are corners of boxes, where rows of cells begin.
      query.add(k % 2 == 0 ? 2.0 * random_point(random) - Vec2(0.5, 0.5)
                           : boxes[random() % boxes.size()].high);
      if (k % 3 == 0) query.add(query.low + random_point(random));
      const double within = k % 4 == 0 ? 0.0 : 0.2 * uniform(random);
      std::vector<int> visits(boxes.size(), 0);
      const auto note = [&](std::int32_t index) {
        ++visits[static_cast<std::size_t>(index)];
        return true;
      };
      EXPECT_TRUE(grid.for_each_near(query, within, note));
      for (std::size_t b = 0; b < boxes.size(); ++b) {
        const bool is_near = boxes[b].comes_within(query, within);
        EXPECT_EQ(visits[b], is_near ? 1 : 0) << "habit " << i % 7;
        near += is_near ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GT(near, all / 20);
}

TEST(BoxGrid, StopsWhereItIsTold) {
  std::vector<Box2> boxes(5);
  for (Box2& box : boxes) box.add({0.0, 0.0});
  int visits = 0;
  EXPECT_FALSE(BoxGrid(boxes).for_each_near(boxes[0], 0.0, [&](std::int32_t) { return ++visits < 3; }));
  EXPECT_EQ(visits, 3);
}

/// Whether a segment meets a box enlarged by the within; clips it by one side after the other.
bool passes(const Box2& box, const Vec2& a, const Vec2& b, double within) {
  double begin = 0.0, end = 1.0;
  for (int k = 0; k < 2; ++k) {
    const double low = box.low[k] - within - a[k], high = box.high[k] + within - a[k], d = b[k] - a[k];
    if (d == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    begin = std::max(begin, std::min(low / d, high / d));
    end = std::min(end, std::max(low / d, high / d));
  }
  return begin <= end;
}

TEST(BoxGrid, ListsEveryBoxThatASegmentPasses) {
  std::mt19937_64 random(2);
  std::size_t near = 0, visited = 0, all = 0;
  for (int i = 0; i < 700; ++i) {
    const std::vector<Box2> boxes = random_boxes(random, i % 7);
    const BoxGrid grid(boxes);
    for (int k = 0; k < 30; ++k) {
      Vec2 a = 2.0 * random_point(random) - Vec2(0.5, 0.5), b = 2.0 * random_point(random) - Vec2(0.5, 0.5);
      if (k % 5 == 1) b[1] = a[1];
      if (k % 5 == 2) b[0] = a[0];
      if (k % 5 >= 3) {
        // Along the side of a box, exactly or nearly.
        const Box2& box = boxes[random() % boxes.size()];
        a = box.high;
        b = k % 5 == 3 ? Vec2(box.low[0], box.high[1]) : Vec2(box.high[0], box.low[1]);
        b += 1e-15 * (random_point(random) - Vec2(0.5, 0.5)) * static_cast<double>(random() % 3);
      }
      if (k % 7 == 0) b = a;
      // Callers never ask with less than a few roundings.
      const double within = k % 2 == 0 ? 1e-14 : 0.1 * uniform(random);
      std::vector<bool> is_visited(boxes.size(), false);
      grid.for_each_near(a, b, within,
                         [&](std::int32_t index) { is_visited[static_cast<std::size_t>(index)] = true; });
      for (std::size_t j = 0; j < boxes.size(); ++j) {
        const bool is_near = passes(boxes[j], a, b, within);
        if (is_near) {
          EXPECT_TRUE(is_visited[j]) << "habit " << i % 7 << " from " << a.transpose() << " to "
                                     << b.transpose();
        }
        near += is_near ? 1 : 0;
        visited += is_visited[j] ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GT(near, all / 20);
  EXPECT_LT(visited, all / 2) << "it is a grid";
}

TEST(BoxGrid, KnowsItsBoundsAndHoldsNothingWithoutBoxes) {
  std::vector<Box2> boxes(2);
  boxes[0].add({1.0, 2.0});
  boxes[1].add({-1.0, 3.0});
  const BoxGrid grid(boxes);
  EXPECT_EQ(grid.low(), Vec2(-1.0, 2.0));
  EXPECT_EQ(grid.high(), Vec2(1.0, 3.0));
  for (const BoxGrid& empty : {BoxGrid(), BoxGrid(std::vector<Box2>{})}) {
    int visits = 0;
    EXPECT_TRUE(empty.for_each_near(boxes[0], 1.0, [&](std::int32_t) { return ++visits < 0; }));
    empty.for_each_near(Vec2(0.0, 0.0), Vec2(1.0, 1.0), 1.0, [&](std::int32_t) { ++visits; });
    EXPECT_EQ(visits, 0);
  }
}

TEST(BoxGrid, LongBoxesTakeNoMoreThanTheirNumber) {
  // Like triangles round one vertex: each box covers a tenth of as many cells as there are boxes.
  std::vector<Box2> boxes(20000);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(boxes.size());
    boxes[i].add(Vec2::Zero());
    boxes[i].add(Vec2(std::cos(angle), std::sin(angle)));
  }
  const BoxGrid grid(boxes);
  EXPECT_LE(grid.bytes(), 200 * boxes.size());
  Box2 query;
  query.add(Vec2(0.6, 0.3));
  std::size_t found = 0, expected = 0;
  grid.for_each_near(query, 0.01, [&](std::int32_t) { return ++found > 0; });
  for (const Box2& box : boxes) expected += box.comes_within(query, 0.01) ? 1 : 0;
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace lmdbench
