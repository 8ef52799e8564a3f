// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// Parts at rest in each other: contacts of faces at an angle stay apart however near they are.
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/triangle_distance.h>

#include <gtest/gtest.h>
#include <support/lmd_text.h>
#include <support/rounded.h>
#include <support/shape_scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::ShapeScene;
using testing::text;
using testing::turned_by;

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * testing::uniform(random);
}

/// A prism from y = 0 to `depth` over a polygon without holes that has these triangles.
TriangleMesh prism(const std::vector<Vec2>& outline, const std::vector<std::array<std::int32_t, 3>>& caps,
                   double depth) {
  TriangleMesh mesh;
  const auto n = static_cast<std::int32_t>(outline.size());
  for (const double y : {0.0, depth})
    for (const Vec2& x : outline) mesh.vertices.emplace_back(x.x(), y, x.y());
  for (const auto& [a, b, c] : caps) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a + n, c + n, b + n});
  }
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t k = (i + 1) % n;
    mesh.triangles.push_back({i, i + n, k});
    mesh.triangles.push_back({k, i + n, k + n});
  }
  return mesh;
}

/// Floor z = 0 for x >= 0 and wall x = 0 for z >= 0.
TriangleMesh inner_corner(double size, double depth) {
  const double t = 0.3 * size;
  return prism({{-t, -t}, {size, -t}, {size, 0}, {0, 0}, {0, size}, {-t, size}},
               {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}, depth);
}

/// Lies on top of z = 0 for x < 0 and hangs down beside x = 0.
TriangleMesh hook(double size, double depth) {
  const double t = 0.3 * size;
  return prism({{-size, 0}, {0, 0}, {0, -size}, {t, -size}, {t, t}, {-size, t}},
               {{0, 1, 5}, {1, 4, 5}, {1, 2, 3}, {1, 3, 4}}, depth);
}

struct Expected {
  double distance;
  Vec3 direction;
};

void expect_lmds(ShapeScene& scene, const Pose& pose, const Pose& whole,
                 const std::vector<Expected>& expected, double spare) {
  LmdSet lmds = scene.lmds(pose);
  ASSERT_EQ(lmds.size(), expected.size()) << text(lmds);
  for (const Expected& one : expected)
    EXPECT_TRUE(std::ranges::any_of(lmds,
                                    [&](const Lmd& lmd) {
                                      return std::abs(lmd.distance - one.distance) <= spare &&
                                             (lmd.direction - whole.rotation * one.direction).norm() <= 1e-6;
                                    }))
        << one.distance << " along " << one.direction.transpose() << " in " << text(lmds);
}

TEST(Rest, ABoxInAnInnerCornerHasOneLmdAWall) {
  std::mt19937_64 random(44);
  for (int k = 0; k < 300; ++k) {
    const double size = std::pow(10.0, uniform(random, -2.0, 1.0)), side = 0.4 * size;
    const auto gap = [&] { return size * std::pow(10.0, uniform(random, -12.0, -4.0)); };
    const double a = gap(), b = gap();
    const Pose whole = k % 4 == 0 ? Pose{} : testing::pose_of_seed(k);
    ShapeScene scene(translated(make_box({side, side, side}), Vec3::Constant(0.5 * side)),
                     testing::placed(inner_corner(size, size), whole), 0.1 * size);
    const Pose rest = whole * turned_by(0.0, Vec3::UnitZ(), Vec3(a, 0.3 * size, b));
    SCOPED_TRACE(::testing::Message() << "pose " << k << " size " << size << " gaps " << a << ", " << b);
    expect_lmds(scene, rest, whole, {{a, -Vec3::UnitX()}, {b, -Vec3::UnitZ()}}, 1e-13 * size);
  }
}

TEST(Rest, AHookThatRestsKeepsTheLmdOfItsLeg) {
  std::mt19937_64 random(45);
  for (int k = 0; k < 300; ++k) {
    const double h = std::pow(10.0, uniform(random, -13.0, -5.0)),
                 s = std::pow(10.0, uniform(random, -3.0, -0.7));
    const Pose whole = k % 4 == 0 ? Pose{} : testing::pose_of_seed(k);
    ShapeScene scene(hook(1.0, 0.7),
                     testing::placed(translated(make_box({1.0, 1.0, 1.0}), Vec3(-0.5, 0.5, -0.5)), whole),
                     0.5);
    const Pose rest = whole * turned_by(0.0, Vec3::UnitZ(), Vec3(s, 0.1, h));
    SCOPED_TRACE(::testing::Message() << "pose " << k << " gaps " << h << ", " << s);
    expect_lmds(scene, rest, whole, {{h, -Vec3::UnitZ()}, {s, -Vec3::UnitX()}}, 2e-13);
  }
}

/// All pairs of triangles that intersect.
std::vector<Intersection> intersections_of(const ShapePair& pair) {
  const Surface &moving = pair.moving.surface, &fixed = pair.fixed.surface;
  std::vector<Intersection> result;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(moving.mesh.triangles.size()); ++t)
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(fixed.mesh.triangles.size()); ++s) {
      const TrianglePairDistance d = triangle_distance(pair.moving.triangle(t), pair.fixed.triangle(s));
      if (d.intersecting) result.push_back(intersection_of(pair, t, s, 0, d));
    }
  return result;
}

LmdSet lmds_with_intersections(ShapeScene& scene, const Pose& pose,
                               std::vector<Intersection>& intersections) {
  const ShapePair pair = scene.at(pose);
  ContactSet contacts = scene.contacts(pair);
  intersections = intersections_of(pair);
  LmdSet lmds;
  join_contacts(pair, 0, contacts, intersections, lmds);
  return lmds;
}

TEST(Rest, ABoxInAnInnerCornerIntersectsWhereItIsInTheWall) {
  // It rests on the floor; its triangles in the wall are at that contact, on both sides of it.
  for (const double depth : {1e-12, 1e-6, 0.01}) {
    ShapeScene scene(translated(make_box({0.4, 0.4, 0.4}), Vec3::Constant(0.2)), inner_corner(1.0, 1.0), 0.1);
    std::vector<Intersection> intersections;
    const LmdSet lmds =
        lmds_with_intersections(scene, turned_by(0.0, Vec3::UnitZ(), Vec3(-depth, 0.3, 0.0)), intersections);
    EXPECT_FALSE(intersections.empty()) << depth;
    for (const Lmd& lmd : lmds) EXPECT_NE(lmd.feature_moving.kind, FeatureKind::FACE) << text(lmds);
  }
}

TEST(Rest, ABoxThatOverhangsTwoEdgesTouchesWithADirection) {
  // Its walls cross the other's, each on both sides of the other's plane; the contact's is between.
  std::mt19937_64 random(46);
  std::size_t intersecting = 0;
  for (int k = 0; k < 200; ++k) {
    const Pose whole = k % 4 == 0 ? Pose{} : testing::pose_of_seed(k);
    ShapeScene scene(make_box({1.0, 1.0, 1.0}), testing::placed(make_box({1.0, 1.0, 1.0}), whole), 0.1);
    const double height = 1.0 + std::array{0.0, 2e-16, -2e-16, 1e-15}[static_cast<std::size_t>(k) / 4 % 4];
    const Vec3 at(uniform(random, 0.1, 0.8), uniform(random, -0.8, -0.1), height);
    const ShapePair pair = scene.at(whole * turned_by(0.0, Vec3::UnitZ(), at));
    ContactSet contacts = scene.contacts(pair);
    std::vector<Intersection> intersections = intersections_of(pair);
    intersecting += intersections.empty() ? 0 : 1;
    LmdSet lmds;
    join_contacts(pair, 0, contacts, intersections, lmds);
    EXPECT_TRUE(intersections.empty()) << "pose " << k;
    ASSERT_EQ(lmds.size(), 1u) << "pose " << k << text(lmds);
    EXPECT_NEAR((lmds[0].direction + whole.rotation * Vec3::UnitZ()).norm(), 0.0, 1e-12) << "pose " << k;
    const Vec3 middle = 0.5 * at;
    EXPECT_NEAR(
        (RigidTransform(whole.inverse()).point(lmds[0].point_fixed) - Vec3(middle.x(), middle.y(), 0.5))
            .norm(),
        0.0, 1e-9);
  }
  EXPECT_GT(intersecting, 50u);
}

/// A prism of n sides along y with a hole of n sides in it, `gap` wider than a peg of radius 0.3.
TriangleMesh nut(int n, double gap) {
  TriangleMesh mesh;
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n, inner = 0.3 + gap / std::cos(std::numbers::pi / n);
    const Vec3 x(std::cos(angle), 0.0, std::sin(angle)), y = Vec3::UnitY();
    for (const Vec3& p : {Vec3(inner * x), Vec3(inner * x + y), Vec3(0.6 * x), Vec3(0.6 * x + y)})
      mesh.vertices.push_back(p);
  }
  for (int k = 0; k < n; ++k) {
    const int a = 4 * k, b = 4 * ((k + 1) % n);
    for (const auto& [p, q, r, s] :
         {std::array{a, b, b + 1, a + 1}, std::array{a + 2, a + 3, b + 3, b + 2},
          std::array{a, a + 2, b + 2, b}, std::array{a + 1, b + 1, b + 3, a + 3}}) {
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({p, r, s});
    }
  }
  return mesh;
}

/// A prism over a polygon that all of its first corner's diagonals stay in.
TriangleMesh fan_prism(const std::vector<Vec2>& outline, double depth) {
  std::vector<std::array<std::int32_t, 3>> caps;
  for (std::int32_t k = 1; k + 1 < static_cast<std::int32_t>(outline.size()); ++k)
    caps.push_back({0, k, k + 1});
  return prism(outline, caps, depth);
}

TriangleMesh peg(int n) {
  std::vector<Vec2> outline;
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n;
    outline.emplace_back(0.3 * std::cos(angle), 0.3 * std::sin(angle));
  }
  return translated(fan_prism(outline, 0.5), Vec3(0.0, 0.2, 0.0));
}

/// An edge's foot beside an obtuse inner corner counts as at its end; the other face is no nearer.
TEST(Rest, APegInItsHoleHasOneLmdAWall) {
  for (const int n : {4, 6, 12, 40})
    for (double gap = 3e-14; gap < 1e-11; gap *= 1.13) {
      ShapeScene scene(peg(n), nut(n, gap), 0.01);
      const LmdSet lmds = scene.lmds(Pose{});
      EXPECT_EQ(lmds.size(), static_cast<std::size_t>(n)) << n << " walls, gap " << gap << text(lmds);
    }
}

/// Facets each of which has the direction of the next: one LMD, however far apart the first and
/// last are and however both are turned.
TEST(Rest, ABearingOfFacetsHasOneLmd) {
  constexpr int FACETS = 15;
  constexpr double GAP = 1e-7, ANGLE = 1e-3;
  const auto arc = [&](double radius, int k) {
    const double angle = ANGLE * (k - 0.5 * FACETS);
    return Vec2(radius * std::sin(angle), -radius * std::cos(angle));
  };
  std::vector<Vec2> shaft, bed{{-0.02, -2.0}, {0.02, -2.0}};
  for (int k = 0; k <= FACETS; ++k) shaft.push_back(arc(1.0, k));
  for (int k = FACETS; k >= 0; --k) bed.push_back(arc(1.0 + GAP, k));
  shaft.insert(shaft.end(), {{0.02, -0.5}, {-0.02, -0.5}});
  std::rotate(shaft.begin(), shaft.end() - 1, shaft.end());
  for (int k = 0; k < 12; ++k) {
    const Pose whole =
        k < 4 ? turned_by(0.5 * std::numbers::pi * k, Vec3::UnitZ(), Vec3::Zero()) : testing::pose_of_seed(k);
    ShapeScene scene(fan_prism(shaft, 0.02), testing::placed(fan_prism(bed, 0.02), whole), 1e-3);
    const LmdSet lmds = scene.lmds(whole);
    EXPECT_EQ(lmds.size(), 1u) << k << text(lmds);
    EXPECT_NEAR(lmds[0].distance, GAP, 1e-13) << k;
  }
}

/// Where a shallow tip is pressed in by less than rounding its faces cross farther from it than
/// the tolerance: it touches or intersects, not both.
TEST(Rest, AShallowTipThatIsPressedInIsOneContact) {
  std::size_t intersecting = 0, touching = 0;
  for (int k = 0; k < 400; ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const double slope = std::pow(10.0, uniform(random, -6.5, -4.0));
    TriangleMesh tip = make_box({1.0, 1.0, 1.0});
    const auto middle = static_cast<std::int32_t>(tip.vertices.size());
    std::erase_if(tip.triangles, [&](const auto& t) {
      return std::ranges::all_of(t,
                                 [&](auto v) { return tip.vertices[static_cast<std::size_t>(v)].z() < 0.0; });
    });
    tip.vertices.emplace_back(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), -0.5 - slope);
    std::vector<std::int32_t> base;
    for (std::int32_t v = 0; v < middle; ++v)
      if (tip.vertices[static_cast<std::size_t>(v)].z() < 0.0) base.push_back(v);
    std::ranges::sort(base, {}, [&](std::int32_t v) {
      const Vec3& x = tip.vertices[static_cast<std::size_t>(v)];
      return std::atan2(x.y(), x.x());
    });
    for (std::size_t i = 0; i < 4; ++i) tip.triangles.push_back({base[(i + 1) % 4], base[i], middle});
    const Pose whole = k % 4 == 0 ? Pose{} : testing::pose_of_seed(k);
    ShapeScene scene(tip, testing::placed(make_box({1.5, 1.5, 1.0}), whole), 0.1);
    const double rounding = scene.at(whole).tolerance.rounding;
    const double tilt = uniform(random, 0.0, 0.5) * slope;
    const double depth = uniform(random, -0.2, 3.0) * rounding;
    Pose pose = turned_by(tilt, Vec3(1.0, uniform(random, -1.0, 1.0), 0.0), Vec3::Zero());
    const Vec3 lowest = pose.rotation * tip.vertices[static_cast<std::size_t>(middle)];
    pose.translation = Vec3(0.0, 0.0, 0.5 - depth - lowest.z());
    std::vector<Intersection> intersections;
    const LmdSet lmds = lmds_with_intersections(scene, whole * pose, intersections);
    EXPECT_EQ(lmds.size() + (intersections.empty() ? 0 : 1), 1u)
        << "pose " << k << " slope " << slope << " depth " << depth / rounding << text(lmds);
    intersecting += intersections.empty() ? 0 : 1;
    touching += lmds.size();
  }
  EXPECT_GT(intersecting, 50u);
  EXPECT_GT(touching, 50u);
}

}  // namespace
}  // namespace lmdbench
