// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/segment_distance.h>

#include <gtest/gtest.h>
#include <support/random_polygon.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::random_convex_polygon;
using testing::uniform;

Vec2 random_point(std::mt19937_64& random, double size) {
  return size * Vec2(uniform(random) - 0.5, uniform(random) - 0.5);
}

/// Greatest height over the lines of the sides: not positive inside.
double height_over_sides(const ConvexPolygon& polygon, const Vec2& x) {
  double highest = -1e300;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Vec2 side = polygon.corners[(k + 1) % polygon.corners.size()] - polygon.corners[k];
    highest = std::max(highest, -cross(side, x - polygon.corners[k]) / side.norm());
  }
  return highest;
}

/// Distance of two convex polygons without a common point.
double distance_between(const ConvexPolygon& a, const ConvexPolygon& b) {
  const auto lift = [](const Vec2& x) { return Vec3(x[0], x[1], 0.0); };
  const auto side = [&](const ConvexPolygon& p, std::size_t k) {
    return Segment{lift(p.corners[k]), lift(p.corners[(k + 1) % p.corners.size()])};
  };
  double least = 1e300;
  for (std::size_t i = 0; i < a.corners.size(); ++i)
    for (std::size_t j = 0; j < b.corners.size(); ++j)
      least = std::min(least, segment_distance(side(a, i), side(b, j)).squared_distance);
  return std::sqrt(least);
}

TEST(Box2, HoldsWhatWasAddedAndComesNearClosed) {
  Box2 box;
  box.add({1.0, 5.0});
  box.add({3.0, 4.0});
  EXPECT_EQ(box.low, Vec2(1.0, 4.0));
  EXPECT_EQ(box.high, Vec2(3.0, 5.0));
  Box2 right;
  right.add({3.5, 0.0});
  right.add({4.0, 9.0});
  EXPECT_FALSE(box.comes_within(right, 0.25));
  EXPECT_TRUE(box.comes_within(right, 0.5));
  EXPECT_TRUE(right.comes_within(box, 0.5));
  Box2 above;
  above.add({2.0, 5.5});
  EXPECT_FALSE(box.comes_within(above, 0.25));
  EXPECT_TRUE(box.comes_within(above, 0.5));
  EXPECT_TRUE(above.comes_within(box, 0.5));
  EXPECT_FALSE(Box2().comes_within(box, 1e9)) << "nothing is near an empty box";
}

TEST(PlanarFrame, IsRightHandedAndGoesThereAndBack) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 n = testing::random_direction(random), point = testing::random_direction(random);
    const PlanarFrame frame(point, n);
    EXPECT_NEAR((frame.u.cross(frame.v) - n).norm(), 0.0, 1e-15);
    const Vec2 x = random_point(random, 3.0);
    EXPECT_NEAR((frame.flat(frame.lifted(x)) - x).norm(), 0.0, 1e-14);
    EXPECT_NEAR((frame.flat(frame.lifted(x) + 7.0 * n) - x).norm(), 0.0, 1e-14) << "along the normal";
    EXPECT_NEAR(n.dot(frame.lifted(x) - point), 0.0, 1e-14);
    // The triangles become counter-clockwise, whatever their order of corners.
    const Triangle t{frame.lifted({0, 0}), frame.lifted({1, 0}), frame.lifted({0, 2})};
    EXPECT_NEAR(ConvexPolygon(frame, t).measure().area, 1.0, 1e-14);
    EXPECT_NEAR(ConvexPolygon(frame, {t[0], t[2], t[1]}).measure().area, 1.0, 1e-14);
  }
}

TEST(ConvexHull, HoldsAllPointsAndTurnsLeftAtEach) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 400; ++i) {
    // Coordinates are whole numbers: products are exact, and many points coincide or are collinear.
    std::vector<Vec2> points(1 + random() % 30);
    const std::uint64_t range = 1 + random() % 12;
    for (Vec2& x : points)
      x = Vec2(static_cast<double>(random() % range), static_cast<double>(random() % range));
    const std::vector<Vec2> hull = convex_hull(points);
    const auto is_point = [&](const Vec2& x) { return std::ranges::find(points, x) != points.end(); };
    EXPECT_TRUE(std::ranges::all_of(hull, is_point));
    ASSERT_GE(hull.size(), 1u);
    if (hull.size() < 3) {
      // All on the segment between the two.
      for (const Vec2& x : points) {
        EXPECT_EQ(cross(hull.back() - hull.front(), x - hull.front()), 0.0);
        EXPECT_LE((x - hull.front()).dot(x - hull.back()), 0.0);
      }
      continue;
    }
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 &a = hull[k], &b = hull[(k + 1) % hull.size()], &c = hull[(k + 2) % hull.size()];
      EXPECT_GT(cross(b - a, c - b), 0.0);
      for (const Vec2& x : points) EXPECT_GE(cross(b - a, x - a), 0.0);
    }
  }
  EXPECT_TRUE(convex_hull({}).empty());
}

TEST(FarthestAlong, IsTheCornerThatALookAtAllFinds) {
  std::mt19937_64 random(7);
  for (int sample = 0; sample < 2000; ++sample) {
    std::vector<Vec2> points;
    const int count = 1 + sample % 40;
    // On a coarse grid: sides along the axes, sides of one direction, corners one above the other.
    const double step = sample % 3 == 0 ? 0.25 : 1e-9;
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * uniform(random);
      points.emplace_back(step * std::round(std::cos(angle) / step),
                          step * std::round(std::sin(angle) / step));
    }
    const std::vector<Vec2> hull = convex_hull(points);
    std::vector<Vec2> axes{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {uniform(random), uniform(random)}};
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 side = hull[(k + 1) % hull.size()] - hull[k];
      axes.insert(axes.end(), {{side[1], -side[0]}, {-side[1], side[0]}});
    }
    for (const Vec2& axis : axes) {
      double greatest = axis.dot(hull.front());
      for (const Vec2& x : hull) greatest = std::max(greatest, axis.dot(x));
      ASSERT_NEAR(axis.dot(farthest_along(hull, axis)), greatest, 1e-15) << "sample " << sample;
    }
  }
}

TEST(WidthOf, IsTheLeastOverAllDirections) {
  EXPECT_EQ(width_of({}), 0.0);
  EXPECT_EQ(width_of(std::vector<Vec2>{{0, 0}, {1, 0}}), 0.0);
  EXPECT_DOUBLE_EQ(width_of(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 1}, {0, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(width_of(std::vector<Vec2>{{0, 0}, {3, 0}, {0, 4}}), 12.0 / 5.0)
      << "over the longest side";
  std::mt19937_64 random(3);
  for (int i = 0; i < 40; ++i) {
    const ConvexPolygon polygon = random_convex_polygon(random, 12);
    const double width = width_of(polygon.corners);
    double least = 1e300;
    for (int k = 0; k < 2000; ++k) {
      const double angle = std::numbers::pi * k / 2000.0;
      const Vec2 axis(std::cos(angle), std::sin(angle));
      double low = 1e300, high = -1e300;
      for (const Vec2& x : polygon.corners) {
        low = std::min(low, axis.dot(x));
        high = std::max(high, axis.dot(x));
      }
      least = std::min(least, high - low);
    }
    EXPECT_LE(width, least + 1e-12);
    EXPECT_GE(width, least - 2.0 * 3.2 / 2000.0) << "a turn by half a step narrows it by no more";
  }
}

TEST(AreaAndCentroid, AreThoseOfTheTriangles) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 100; ++i) {
    const ConvexPolygon polygon = random_convex_polygon(random, 9);
    // The fan starts at a point inside instead of a corner.
    Vec2 middle = Vec2::Zero();
    for (const Vec2& x : polygon.corners) middle += x / static_cast<double>(polygon.corners.size());
    double area = 0.0;
    Vec2 moment = Vec2::Zero();
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const Vec2 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.corners.size()];
      const double part = 0.5 * cross(a - middle, b - middle);
      area += part;
      moment += part * (a + b + middle) / 3.0;
    }
    const AreaAndCentroid measure = polygon.measure();
    EXPECT_NEAR(measure.area, area, 1e-14);
    EXPECT_NEAR((measure.centroid - moment / area).norm(), 0.0, 1e-12);
    EXPECT_TRUE(polygon.holds(measure.centroid, 0.0));
  }
  EXPECT_EQ(ConvexPolygon({{0, 0}, {1, 1}}).measure().area, 0.0);
}

TEST(CutBy, HoldsWhatBothHold) {
  std::mt19937_64 random(5);
  int common = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexPolygon a = random_convex_polygon(random, 8);
    ConvexPolygon b = random_convex_polygon(random, 8);
    const Vec2 away = random_point(random, 2.0);
    for (Vec2& x : b.corners) x += away;
    const ConvexPolygon cut = a.cut_by(b);
    EXPECT_NEAR(cut.measure().area, b.cut_by(a).measure().area, 1e-13);
    for (const Vec2& x : cut.corners) {
      EXPECT_LE(height_over_sides(a, x), 1e-14);
      EXPECT_LE(height_over_sides(b, x), 1e-14);
    }
    for (int k = 0; k < 100; ++k) {
      const Vec2 x = random_point(random, 2.0);
      const double height = std::max(height_over_sides(a, x), height_over_sides(b, x));
      if (std::abs(height) < 1e-9) continue;
      EXPECT_EQ(cut.holds(x, 0.0), height < 0.0);
      common += height < 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(common, 1000);
}

TEST(PartOf, IsWhatIsNoFartherOutsideThanTheReach) {
  std::mt19937_64 random(6);
  int parts = 0, none = 0;
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolygon polygon = random_convex_polygon(random, 3 + static_cast<int>(random() % 8));
    const Vec2 p = random_point(random, 3.0), q = random_point(random, 3.0);
    const double within = i % 2 == 0 ? 0.0 : 0.2 * uniform(random);
    const SegmentPart part = polygon.part_of(p, q, within);
    const bool is_some = part.end > part.begin;
    (is_some ? parts : none) += 1;
    for (int k = 0; k <= 50; ++k) {
      const double s = k / 50.0;
      const Vec2 x = p + s * (q - p), along = (q - p).normalized();
      const Extent extent = extent_along(polygon.corners, along);
      const double beyond = std::max(extent.least - along.dot(x), along.dot(x) - extent.greatest);
      const double height = std::max(height_over_sides(polygon, x) - within, beyond - 2.0 * within);
      if (height < -1e-12) {
        EXPECT_TRUE(is_some && part.begin <= s && s <= part.end)
            << s << " of " << part.begin << " " << part.end;
      } else if (height > 1e-12) {
        EXPECT_FALSE(is_some && part.begin < s - 1e-12 && s + 1e-12 < part.end);
      }
    }
    if (!is_some) continue;
    EXPECT_GE(part.begin, 0.0);
    EXPECT_LE(part.end, 1.0);
    for (const double s : {part.begin, part.end})
      EXPECT_LE(height_over_sides(polygon, p + s * (q - p)), within + 1e-12);
  }
  EXPECT_GT(parts, 500);
  EXPECT_GT(none, 300);
}

TEST(PartOf, ASegmentAlongASideIsInside) {
  const ConvexPolygon square({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const auto part_at = [&](double y, double within) { return square.part_of({-1.0, y}, {3.0, y}, within); };
  for (const double y : {0.0, 0.5, 1.0}) {
    const SegmentPart part = part_at(y, 0.0);
    EXPECT_EQ(part.begin, 0.25) << y;
    EXPECT_EQ(part.end, 0.5) << y;
  }
  for (const double beside : {1e-16, 1e-12, 1e-3}) {
    EXPECT_FALSE(part_at(-beside, 0.0).end > 0.0);
    EXPECT_FALSE(part_at(1.0 + 4.0 * beside, beside).end > 0.0);
    EXPECT_FALSE(part_at(-beside, 0.5 * beside).end > 0.0);
    const SegmentPart part = part_at(-beside, 2.0 * beside);
    EXPECT_NEAR(part.begin, 0.25, beside);
    EXPECT_NEAR(part.end, 0.5, beside);
  }
  EXPECT_FALSE(ConvexPolygon().part_of({0, 0}, {1, 0}, 9.0).end > 0.0) << "nothing is in nothing";
}

TEST(PartOf, ASegmentEndsAtTheTipOfANeedle) {
  const double width = 1e-11, within = 1e-14;
  const ConvexPolygon needle({{0, 0}, {1, 0}, {0, width}});
  for (const double slope : {0.0, -width, 1e-9}) {
    const Vec2 tip(1.0, 0.0), along(1.0, slope);
    const SegmentPart part = needle.part_of(tip - along, tip + along, within);
    EXPECT_LE(part.end, 0.5 + 2.0 * within) << slope;
    EXPECT_GE(part.end, 0.5 - within) << slope;
    EXPECT_FALSE(needle.part_of(tip + 1e-6 * along, tip + along, within).end > 0.0) << slope;
  }
}

TEST(Holds, IsClosedAtTheReach) {
  const ConvexPolygon square({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const Vec2& on : {Vec2(0, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(1, 1)})
    EXPECT_TRUE(square.holds(on, 0.0));
  EXPECT_TRUE(square.holds({1.0, 1.5}, 0.5));
  EXPECT_TRUE(square.holds({1.375, 1.5}, 0.625)) << "of a corner";
  EXPECT_FALSE(square.holds({1.5, 1.5}, 0.625)) << "of both sides, not of their corner";
  EXPECT_FALSE(square.holds({-0.625, 0.5}, 0.5));
  EXPECT_FALSE(ConvexPolygon().holds({0, 0}, 1e9));
  std::mt19937_64 random(7);
  for (int i = 0; i < 500; ++i) {
    const ConvexPolygon polygon = random_convex_polygon(random, 7);
    const Vec2 x = random_point(random, 3.0);
    const double within = 0.3 * uniform(random);
    const double distance =
        height_over_sides(polygon, x) <= 0.0 ? 0.0 : distance_between(polygon, ConvexPolygon({x}));
    if (std::abs(distance - within) > 1e-12) {
      EXPECT_EQ(polygon.holds(x, within), distance < within);
    }
  }
}

TEST(Touches, TellsWhetherTheDistanceIsWithinReach) {
  std::mt19937_64 random(8);
  int near = 0, apart = 0;
  for (int i = 0; i < 3000; ++i) {
    const ConvexPolygon a = random_convex_polygon(random, 3 + static_cast<int>(random() % 8));
    // Two corners make a segment.
    ConvexPolygon b = i % 3 == 0 ? ConvexPolygon({random_point(random, 2.0), random_point(random, 2.0)})
                                 : random_convex_polygon(random, 5);
    const Vec2 away = random_point(random, 3.0);
    for (Vec2& x : b.corners) x += away;
    const double within = i % 2 == 0 ? 0.0 : 0.3 * uniform(random);
    const bool touches = a.touches(b, within);
    EXPECT_EQ(touches, b.touches(a, within));
    const auto meets = [&] {
      return std::ranges::any_of(a.corners,
                                 [&](const Vec2& x) { return b.corners.size() > 2 && b.holds(x, 0.0); }) ||
             std::ranges::any_of(b.corners, [&](const Vec2& x) { return a.holds(x, 0.0); });
    };
    const double distance = meets() ? 0.0 : distance_between(a, b);
    if (distance < within - 1e-12 || distance == 0.0) {
      EXPECT_TRUE(touches) << i;
      ++near;
    }
    if (distance > within + 1e-12) {
      EXPECT_FALSE(touches) << i;
      ++apart;
    }
  }
  EXPECT_GT(near, 500);
  EXPECT_GT(apart, 300);
  // Squares side by side, no farther apart than the within.
  const ConvexPolygon square({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), next({{1.5, 0}, {2, 0}, {2, 1}, {1.5, 1}});
  EXPECT_TRUE(square.touches(next, 0.5));
  EXPECT_FALSE(square.touches(next, 0.49));
  // Sharp corners of two pieces on both sides of a slit: sides run on as if they met.
  const ConvexPolygon sharp({{0, 0}, {1, -0.01}, {1, 0.01}}), other({{-0.02, 0}, {-1, 0.01}, {-1, -0.01}});
  EXPECT_FALSE(sharp.touches(other, 0.015));
  EXPECT_FALSE(sharp.holds({-0.02, 0.0}, 0.015));
  EXPECT_TRUE(sharp.touches(other, 0.0201));
}

}  // namespace
}  // namespace lmdbench
