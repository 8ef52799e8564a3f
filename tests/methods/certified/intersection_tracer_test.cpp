// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/triangle_intersection.h>
#include <lmdbench/methods/certified/intersection_tracer.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lmdbench {
namespace {

using Exact = boost::multiprecision::cpp_rational;
using Wide = boost::multiprecision::cpp_bin_float_50;
using ExactPoint = std::array<Exact, 3>;

ExactPoint exact(const Vec3& p) {
  return {Exact(p[0]), Exact(p[1]), Exact(p[2])};
}
ExactPoint minus(const ExactPoint& a, const ExactPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact dot(const ExactPoint& a, const ExactPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The points in which edges of t meet the plane of s inside s.
void collect_piercings(const Triangle& t, const Triangle& s, std::vector<ExactPoint>& points) {
  const ExactPoint s0 = exact(s[0]), normal = cross(minus(exact(s[1]), s0), minus(exact(s[2]), s0));
  for (int k = 0; k < 3; ++k) {
    const ExactPoint p = exact(t[k]), q = exact(t[(k + 1) % 3]);
    const Exact hp = dot(normal, minus(p, s0)), hq = dot(normal, minus(q, s0));
    if (hp * hq > 0 || hp == hq) continue;
    const Exact part = hp / (hp - hq);
    ExactPoint x;
    for (int i = 0; i < 3; ++i) x[i] = p[i] + part * (q[i] - p[i]);
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const ExactPoint corner = exact(s[i]), next = exact(s[(i + 1) % 3]);
      inside = inside && dot(cross(minus(next, corner), minus(x, corner)), normal) >= 0;
    }
    if (inside) points.push_back(x);
  }
}

/// Sum over all pairs of triangles of their common length, in exact arithmetic but for the roots.
double exact_length(const Scene& scene, const Pose& pose) {
  const RigidTransform X_WM(pose);
  Wide sum = 0;
  const TriangleMesh& moving = scene.moving->surface().mesh;
  const TriangleMesh& fixed = scene.fixed[0]->surface().mesh;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(moving.triangles.size()); ++i) {
    const Triangle a = X_WM.triangle(moving.triangle(i));
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(fixed.triangles.size()); ++j) {
      const Triangle b = fixed.triangle(j);
      if (!triangles_intersect(a, b)) continue;
      std::vector<ExactPoint> points;
      collect_piercings(a, b, points);
      collect_piercings(b, a, points);
      Exact longest = 0;
      for (const ExactPoint& x : points)
        for (const ExactPoint& y : points) {
          const ExactPoint d = minus(x, y);
          longest = std::max(longest, Exact(dot(d, d)));
        }
      sum += sqrt(Wide(longest));
    }
  }
  return static_cast<double>(sum);
}

double distance_from(const TriangleMesh& mesh, const RigidTransform& X_WS, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.triangles.size()); ++i)
    least = std::min(least,
                     (point_triangle_distance(point, X_WS.triangle(mesh.triangle(i))).point - point).norm());
  return least;
}

void expect_closed_on_both(const Scene& scene, const Pose& pose,
                           const std::vector<IntersectionPolyline>& lines) {
  const double size = bounding_box_diagonal(scene.fixed[0]->surface().mesh);
  for (const IntersectionPolyline& line : lines) {
    EXPECT_TRUE(line.closed);
    EXPECT_GE(line.points.size(), 3u);
    for (const Vec3& point : line.points) {
      EXPECT_LE(distance_from(scene.moving->surface().mesh, RigidTransform(pose), point), 1e-12 * size);
      EXPECT_LE(distance_from(scene.fixed[0]->surface().mesh, RigidTransform(), point), 1e-12 * size);
    }
  }
}

double length_of(const std::vector<IntersectionPolyline>& lines) {
  double sum = 0.0;
  for (const IntersectionPolyline& line : lines) sum += line.length();
  return sum;
}

Pose at(const Vec3& translation, double angle = 0.0, const Vec3& axis = Vec3::UnitZ()) {
  Pose pose;
  pose.translation = translation;
  pose.rotation = Eigen::AngleAxisd(angle, axis.normalized());
  return pose;
}

TEST(IntersectionTracer, ClosedMeshesMeetInClosedCurvesOfTheExactLength) {
  const Scene scene = testing::make_scene(make_blob(1.0, 0.3, 2), make_torus(1.0, 0.4, 24, 12), 0.05);
  IntersectionTracer tracer(scene);
  std::size_t curves = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const Pose pose = at({1.9 - 0.15 * frame, 0.02, 0.013 * frame}, 0.2 + 0.01 * frame, {1, 2, 3});
    const std::vector<IntersectionPolyline>& lines = tracer.trace(pose);
    curves += lines.size();
    expect_closed_on_both(scene, pose, lines);
    const double expected = exact_length(scene, pose);
    EXPECT_NEAR(length_of(lines), expected, 1e-12 * std::max(expected, 1.0)) << "frame " << frame;
  }
  EXPECT_GT(curves, 10u);
}

TEST(IntersectionTracer, TwoCubesMeetInAHexagon) {
  // A corner inside a corner by (a, b, c): the curve runs along three faces of each cube.
  const Scene scene = testing::make_scene(make_box({1, 1, 1}, 3), make_box({1, 1, 1}, 4), 0.05);
  IntersectionTracer tracer(scene);
  const double a = 0.31, b = 0.27, c = 0.23;
  const Pose pose = at({1.0 - a, 1.0 - b, 1.0 - c});
  const std::vector<IntersectionPolyline>& lines = tracer.trace(pose);
  ASSERT_EQ(lines.size(), 1u);
  expect_closed_on_both(scene, pose, lines);
  EXPECT_NEAR(lines[0].length(), 2.0 * (a + b + c), 1e-12);
}

TEST(IntersectionTracer, WhatOnlyTouchesIsClosedToo) {
  const Scene scene = testing::make_scene(make_box({1, 1, 1}, 2), make_box({1, 1, 1}, 2), 0.05);
  IntersectionTracer tracer(scene);
  for (const Vec3& by :
       {Vec3(0.5, 0.5, 0.0), Vec3(0.5, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), Vec3(0.25, 0.25, 1.0),
        Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1.0), Vec3(-0.5, 0.25, -1.0), Vec3(1.0, 0.5, 0.0)}) {
    const Pose pose = at(by);
    expect_closed_on_both(scene, pose, tracer.trace(pose));
  }
  // Flush sides: the tracer moves the moving cube up and aside; the outline of the overlap is left.
  const std::vector<IntersectionPolyline>& lines = tracer.trace(at({0.5, 0.5, 0.0}));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].length(), 2.0 * (0.5 + 0.5 + 1.0), 1e-12);
}

TEST(IntersectionTracer, EndsAtABoundary) {
  // A strip of one square through a cube's face.
  TriangleMesh sheet;
  sheet.vertices = {{-0.3, 0.05, 0.0}, {0.3, 0.05, 0.0}, {0.3, 0.05, 2.0}, {-0.3, 0.05, 2.0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Scene scene = testing::make_scene(sheet, make_box({1, 1, 1}, 3), 0.05);
  IntersectionTracer tracer(scene);
  const std::vector<IntersectionPolyline>& lines = tracer.trace(at({0.01, 0.02, 0.03}));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_NEAR(lines[0].length(), 0.6, 1e-12);
}

TEST(IntersectionTracer, TheWalkIsTheSameFromAnyFrame) {
  const Scene scene = testing::make_scene(make_blob(1.0, 0.3, 3), make_blob(0.9, 0.3, 3), 0.05);
  IntersectionTracer along(scene);
  for (int frame = 0; frame < 60; ++frame) {
    const Pose pose = at({1.6 - 0.01 * frame, 0.02, 0.0}, 0.1 + 0.002 * frame, {1, 2, 3});
    const std::vector<IntersectionPolyline>& lines = along.trace(pose);
    if (frame % 10 != 0) continue;
    IntersectionTracer fresh(scene);
    const std::vector<IntersectionPolyline>& expected = fresh.trace(pose);
    ASSERT_EQ(lines.size(), expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i].points, expected[i].points);
  }
}

}  // namespace
}  // namespace lmdbench
