// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <support/scenes.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

/// Convex bodies with known faces, and poses with their borders and corners over each other.
namespace lmdbench::testing {

struct ConvexBody {
  std::vector<Vec3> vertices;
  std::vector<std::vector<std::int32_t>> faces;  ///< Convex, counter-clockwise from outside.

  /// Each face becomes a fan round its first corner, or round a vertex in its middle.
  TriangleMesh mesh(bool with_middles = false) const {
    TriangleMesh mesh;
    mesh.vertices = vertices;
    for (const auto& face : faces) {
      if (!with_middles || face.size() == 3) {
        for (std::size_t k = 1; k + 1 < face.size(); ++k)
          mesh.triangles.push_back({face[0], face[k], face[k + 1]});
        continue;
      }
      const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
      // The middle of two opposite corners, so that it lies in the face.
      const Vec3 x = 0.5 * (vertices[static_cast<std::size_t>(face[0])] +
                            vertices[static_cast<std::size_t>(face[face.size() / 2])]);
      mesh.vertices.push_back(x);
      for (std::size_t k = 0; k < face.size(); ++k)
        mesh.triangles.push_back({face[k], face[(k + 1) % face.size()], middle});
    }
    return mesh;
  }
  Vec3 corner(std::size_t face, std::size_t k) const {
    return vertices[static_cast<std::size_t>(faces[face][k % faces[face].size()])];
  }
  Vec3 normal(std::size_t face) const {
    return (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0)).normalized();
  }
};

/// Between a polygon at height 0 and its copy at `height`, scaled by `taper` and moved by `lean`.
inline ConvexBody make_frustum(const std::vector<Vec3>& polygon, double height, double taper,
                               const Vec3& lean) {
  ConvexBody body;
  const auto n = static_cast<std::int32_t>(polygon.size());
  body.vertices = polygon;
  for (const Vec3& x : polygon) body.vertices.push_back(taper * x + lean + height * Vec3::UnitZ());
  std::vector<std::int32_t> bottom, top;
  for (std::int32_t k = 0; k < n; ++k) {
    bottom.push_back(n - 1 - k);
    top.push_back(n + k);
    body.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  body.faces.push_back(bottom);
  body.faces.push_back(top);
  return body;
}

inline ConvexBody make_convex_box(const Vec3& size) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y();
  return make_frustum({{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}}, size.z(), 1.0, Vec3::Zero());
}

/// Regular polygon of n corners about the z axis.
inline std::vector<Vec3> regular_polygon(int n, double radius, double turn) {
  std::vector<Vec3> corners;
  for (int k = 0; k < n; ++k) {
    const double angle = turn + 2.0 * std::numbers::pi * k / n;
    corners.push_back(radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return corners;
}

/// Convex hull of points in general position, by testing every triple.
inline ConvexBody make_hull(const std::vector<Vec3>& points) {
  ConvexBody body;
  body.vertices = points;
  const auto n = static_cast<std::int32_t>(points.size());
  const auto at = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = i + 1; j < n; ++j)
      for (std::int32_t k = j + 1; k < n; ++k) {
        const Vec3 normal = (at(j) - at(i)).cross(at(k) - at(i));
        int above = 0, below = 0;
        for (std::int32_t l = 0; l < n; ++l) {
          if (l == i || l == j || l == k) continue;
          (normal.dot(at(l) - at(i)) > 0.0 ? above : below) += 1;
        }
        if (above == 0) body.faces.push_back({i, j, k});
        if (below == 0) body.faces.push_back({i, k, j});
      }
  return body;
}

inline ConvexBody random_convex_body(std::mt19937_64& random) {
  const auto length = [&] { return 0.2 + 1.3 * uniform(random); };
  switch (random() % 4) {
    case 0:
      // Simple fractions, too, so that borders coincide exactly.
      return random() % 2 == 0 ? make_convex_box({length(), length(), length()})
                               : make_convex_box({0.25 * static_cast<double>(1 + random() % 4),
                                                  0.25 * static_cast<double>(1 + random() % 4), 0.5});
    case 1:
      return make_frustum(
          regular_polygon(3 + static_cast<int>(random() % 10), 0.5 * length(), 6.0 * uniform(random)),
          length(), 1.0, Vec3::Zero());
    case 2:
      return make_frustum(
          regular_polygon(3 + static_cast<int>(random() % 6), 0.5 * length(), uniform(random)), length(),
          0.3 + uniform(random), 0.3 * Vec3(uniform(random) - 0.5, uniform(random) - 0.5, 0.0));
    default:
      break;
  }
  std::vector<Vec3> points(5 + random() % 8);
  for (Vec3& x : points) x = 0.6 * random_direction(random);
  ConvexBody hull = make_hull(points);
  return hull.faces.size() >= 4 ? hull : make_convex_box({1.0, 1.0, 1.0});
}

/// 0 in one case of five, otherwise 10 to a uniform exponent.
inline double power_of_ten(std::mt19937_64& random, double lowest, double highest) {
  return random() % 5 == 0 ? 0.0 : std::pow(10.0, lowest + (highest - lowest) * uniform(random));
}

/// A point of a face: a corner, a point of a side, the middle, or a point between three corners.
inline Vec3 anchor_of(const ConvexBody& body, std::size_t face, std::size_t first, std::mt19937_64& random) {
  const Vec3 a = body.corner(face, first), b = body.corner(face, first + 1), c = body.corner(face, first + 2);
  switch (random() % 5) {
    case 0:
    case 1:
      return a;
    case 2:
      return 0.5 * (a + b);
    case 3:
      return a + uniform(random) * (b - a);
    default: {
      const double s = uniform(random), t = uniform(random) * (1.0 - s);
      return a + s * (b - a) + t * (c - a);
    }
  }
}

/// A face, corner, side or point of the moving body over one of the fixed body, at a gap of 1e-7 to
/// .3; sides along each other, across, or at any angle. In addition moved by 0 or 1e-16 to 1e-5,
/// tilted by 0 or 1e-16 to 1e-2, turned by 0 or 1e-14 to 1e-4.
inline Pose flush_pose(const ConvexBody& moving, const ConvexBody& fixed, std::mt19937_64& random) {
  const auto frame = [](const Vec3& n, const Vec3& along) {
    Mat3 axes;
    axes.col(0) = (along - along.dot(n) * n).normalized();
    axes.col(1) = n.cross(axes.col(0));
    axes.col(2) = n;
    return axes;
  };
  const std::size_t f = random() % moving.faces.size(), g = random() % fixed.faces.size();
  const std::size_t i = random() % moving.faces[f].size(), j = random() % fixed.faces[g].size();
  const Vec3 n = fixed.normal(g);
  const Mat3 of_fixed = frame(n, fixed.corner(g, j + 1) - fixed.corner(g, j));
  Mat3 of_moving = frame(moving.normal(f), moving.corner(f, i + 1) - moving.corner(f, i));
  of_moving.col(2) *= -1.0;
  of_moving.col(1) *= -1.0;
  Mat3 turn = of_fixed * of_moving.transpose();
  const double yaws[] = {0.0, 0.0, std::numbers::pi, 0.5 * std::numbers::pi, 6.28 * uniform(random)};
  const double yaw = yaws[random() % 5];
  const auto about = [](const Vec3& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  if (yaw != 0.0) turn = about(n, yaw) * turn;
  if (const double small = power_of_ten(random, -14.0, -4.0); small > 0.0) turn = about(n, small) * turn;
  const double angles[] = {0.0, 0.5 * std::numbers::pi, 6.28 * uniform(random)};
  const Vec3 axis = about(n, angles[random() % 3]) * of_fixed.col(0);
  const double tilt = power_of_ten(random, -16.0, -2.0);
  if (tilt > 0.0) turn = about(axis, random() % 2 == 0 ? tilt : -tilt) * turn;
  const double gap = random() % 2 == 0 ? 0.3 * uniform(random) : std::pow(10.0, -7.0 + 6.5 * uniform(random));
  const Vec3 sideways = about(n, angles[random() % 3]) * of_fixed.col(0) * power_of_ten(random, -16.0, -5.0);
  Pose pose;
  pose.rotation = Eigen::Quaterniond(turn).normalized();
  pose.translation = anchor_of(fixed, g, j, random) + gap * n + sideways -
                     pose.rotation.toRotationMatrix() * anchor_of(moving, f, i, random);
  return pose;
}

}  // namespace lmdbench::testing
