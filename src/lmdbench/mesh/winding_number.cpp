// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/winding_number.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lmdbench {
namespace {

/// Signed solid angle of a triangle seen from a point [sr].
double solid_angle(const Vec3& point, const Triangle& triangle) {
  const Vec3 a = triangle[0] - point;
  const Vec3 b = triangle[1] - point;
  const Vec3 c = triangle[2] - point;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double winding_number(const Vec3& point, const TriangleMesh& mesh) {
  double angle = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    angle += solid_angle(point, mesh.triangle(static_cast<std::int32_t>(t)));
  return angle / (4.0 * std::numbers::pi);
}

double winding_number(const Vec3& point, const TriangleMesh& mesh, std::span<const std::int32_t> triangles) {
  double angle = 0.0;
  for (const std::int32_t t : triangles) angle += solid_angle(point, mesh.triangle(t));
  return angle / (4.0 * std::numbers::pi);
}

NearWinding::NearWinding(const TriangleMesh& mesh, std::vector<std::int32_t> triangles)
    : mesh_(&mesh), triangles_(std::move(triangles)) {
  build(0, triangles_.size());
}

void NearWinding::build(std::size_t begin, std::size_t end) {
  constexpr std::size_t LEAF = 8;  // triangles
  const auto middle_of = [&](std::int32_t t) {
    const Triangle c = mesh_->triangle(t);
    return Vec3((c[0] + c[1] + c[2]) / 3.0);
  };
  Node node;
  node.begin = begin;
  node.end = end;
  Eigen::AlignedBox3d box;
  double weight = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const Triangle c = mesh_->triangle(triangles_[i]);
    const Vec3 area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
    node.area += area;
    node.centre += area.norm() * middle_of(triangles_[i]);
    weight += area.norm();
    box.extend(middle_of(triangles_[i]));
  }
  node.centre = weight > 0.0 ? Vec3(node.centre / weight) : Vec3(box.center());
  for (std::size_t i = begin; i < end; ++i)
    for (const Vec3& corner : mesh_->triangle(triangles_[i]))
      node.radius = std::max(node.radius, (corner - node.centre).norm());
  const std::size_t place = nodes_.size();
  nodes_.push_back(node);
  if (end - begin <= LEAF) return;
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end),
                   [&](std::int32_t a, std::int32_t b) { return middle_of(a)[axis] < middle_of(b)[axis]; });
  build(begin, half);
  nodes_[place].second = nodes_.size();
  build(half, end);
}

double NearWinding::angle(std::size_t node, const Vec3& point) const {
  constexpr double FAR = 3.0;  // radii
  const Node& here = nodes_[node];
  const Vec3 way = here.centre - point;
  const double distance = way.norm();
  if (distance > FAR * here.radius) return here.area.dot(way) / (distance * distance * distance);
  if (here.second > 0) return angle(node + 1, point) + angle(here.second, point);
  double sum = 0.0;
  for (std::size_t i = here.begin; i < here.end; ++i)
    sum += solid_angle(point, mesh_->triangle(triangles_[i]));
  return sum;
}

double NearWinding::at(const Vec3& point) const {
  return triangles_.empty() ? 0.0 : angle(0, point) / (4.0 * std::numbers::pi);
}

}  // namespace lmdbench
