// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/triangle_normal.h>
#include <lmdbench/shape/signed_features.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench {

namespace {

/// Sectors wider than 180 degrees less this are halved; narrower ones are the cone of their chains.
constexpr double WIDE_SECTOR_MARGIN = 1e-6;
/// Least component [sine] of all normals along a corner's outward direction; else it is FOLDED.
constexpr double LEAST_RISE = 1e-9;
/// Steps of the search for a direction along which all normals rise.
constexpr int MOST_STEPS = 1000;

/// A triangle at a vertex: the next corner and the one after, counter-clockwise.
struct FanTriangle {
  std::int32_t next, last, triangle;
  std::int32_t edge;  ///< To the next corner.
};

/// Triangles round a vertex, counter-clockwise; empty where they are not one closed fan.
std::vector<FanTriangle> fan_round(const Surface& surface, std::int32_t vertex) {
  std::vector<FanTriangle> all;
  for (const std::int32_t t : surface.adjacency.vertex_triangles[vertex]) {
    const auto& c = surface.mesh.triangles[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] == vertex)
        all.push_back({c[(k + 1) % 3], c[(k + 2) % 3], t,
                       surface.adjacency.triangle_edges[static_cast<std::size_t>(t)][k]});
  }
  if (all.empty()) return {};
  const std::int32_t first = all.front().next;
  std::ranges::sort(all, {}, &FanTriangle::next);
  std::vector<FanTriangle> fan;
  while (fan.size() < all.size()) {
    const std::int32_t from = fan.empty() ? first : fan.back().last;
    const auto found = std::ranges::lower_bound(all, from, {}, &FanTriangle::next);
    if (found == all.end() || found->next != from ||
        (!fan.empty() && found->triangle == fan.front().triangle))
      return {};
    fan.push_back(*found);
  }
  if (fan.empty() || fan.back().last != fan.front().next) return {};
  return fan;
}

/// Unit vector along which all normals rise, or zero: a perceptron, which needs a margin.
Vec3 direction_of_all(const std::vector<Vec3>& normals, Vec3 direction) {
  for (int step = 0; step < MOST_STEPS; ++step) {
    const Vec3* lowest = nullptr;
    double least = LEAST_RISE;
    for (const Vec3& normal : normals) {
      if (normal.dot(direction) >= least) continue;
      least = normal.dot(direction);
      lowest = &normal;
    }
    if (lowest == nullptr) return direction;
    direction = (direction + (LEAST_RISE - least + 0.05) * *lowest).normalized();
  }
  return Vec3::Zero();
}

/// Signed area of a counter-clockwise triangle on the unit sphere (Van Oosterom and Strackee 1983).
double signed_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace

SignedFeatures SignedFeatures::of(const Surface& surface, const ShapeComplex& shape) {
  SignedFeatures features;
  features.chains.resize(shape.regions.straight_edges.size());
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(features.chains.size()); ++c)
    features.add_chain(surface, shape, c);
  features.corners.resize(surface.mesh.vertices.size());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(features.corners.size()); ++v)
    if (shape.is_corner(v)) features.add_corner(surface, shape, v);
  return features;
}

bool SignedFeatures::has_index(const FeatureId& shape_feature) const {
  const auto index = static_cast<std::size_t>(shape_feature.index);
  switch (shape_feature.kind) {
    case FeatureKind::VERTEX:
      return corners[index].kind != CornerKind::NONE;
    case FeatureKind::EDGE:
      return chains[index].has_index;
    case FeatureKind::FACE:
      break;
  }
  return true;
}

void SignedFeatures::add_chain(const Surface& surface, const ShapeComplex& shape, std::int32_t index) {
  const std::int32_t edge = shape.lead_of_chain(index);
  const auto triangles = surface.adjacency.edge_triangles[edge];
  if (shape.outer_side(surface, {FeatureKind::EDGE, index}).isZero(0.0) || triangles.size() != 2) return;
  Chain chain;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::int32_t t = triangles[k];
    if (shape.region_of(t) < 0) return;
    chain.sides[k] = {shape.region_of(t), shape.runs_along(surface, index, t) ? 1.0 : -1.0};
  }
  chain.has_index = chain.sides[0].region != chain.sides[1].region;
  chains[static_cast<std::size_t>(index)] = chain;
}

void SignedFeatures::add_corner(const Surface& surface, const ShapeComplex& shape, std::int32_t vertex) {
  if (!surface.has_outer_side({FeatureKind::VERTEX, vertex})) return;
  std::vector<FanTriangle> fan = fan_round(surface, vertex);
  const auto at = [&](std::int32_t v) -> const Vec3& {
    return surface.mesh.vertices[static_cast<std::size_t>(v)];
  };
  const auto chain_before = [&](const FanTriangle& triangle) { return shape.chain_of(triangle.edge); };
  for (const FanTriangle& triangle : fan)
    if (shape.region_of(triangle.triangle) < 0) return;
  // Begins at a chain.
  const auto first =
      std::ranges::find_if(fan, [&](const FanTriangle& triangle) { return chain_before(triangle) >= 0; });
  if (first == fan.end()) return;
  std::rotate(fan.begin(), first, fan.end());

  Corner corner;
  corner.kind = CornerKind::SIMPLE;
  corner.first = static_cast<std::uint32_t>(others.size());
  std::vector<Vec3> normals;
  double whole_angle = 0.0;
  for (std::size_t begin = 0; begin < fan.size();) {
    const std::int32_t chain = chain_before(fan[begin]);
    const std::int32_t region = shape.region_of(fan[begin].triangle);
    double angle = 0.0;
    std::size_t end = begin;
    while (end < fan.size() && (end == begin || chain_before(fan[end]) < 0)) {
      const auto& corners_of = surface.mesh.triangles[static_cast<std::size_t>(fan[end].triangle)];
      const std::array<double, 3> angles = corner_angles(surface.mesh.triangle(fan[end].triangle));
      for (std::size_t k = 0; k < 3; ++k)
        if (corners_of[k] == vertex) angle += angles[k];
      ++end;
    }
    const auto& ends = shape.ends_of_chain(chain);
    const std::int32_t other = ends[0] == vertex ? ends[1] : ends[0];
    const bool at_end = ends[0] == vertex || ends[1] == vertex;
    if (!at_end || !chains[static_cast<std::size_t>(chain)].has_index) corner.kind = CornerKind::NONE;
    const Vec3& normal = shape.regions.planes[static_cast<std::size_t>(region)].normal;
    others.push_back(other);
    regions.push_back(region);
    inner.push_back(angle < std::numbers::pi - WIDE_SECTOR_MARGIN
                        ? Vec3(Vec3::Zero())
                        : Vec3(Eigen::AngleAxisd(0.5 * angle, normal) * (at(other) - at(vertex))));
    normals.push_back(normal);
    whole_angle += angle;
    begin = end;
  }
  corner.count = static_cast<std::uint32_t>(others.size()) - corner.first;
  if (corner.kind == CornerKind::NONE || corner.count < 2) {
    others.resize(corner.first);
    regions.resize(corner.first);
    inner.resize(corner.first);
    return;
  }
  corner.outward = direction_of_all(normals, surface.pseudo_normal({FeatureKind::VERTEX, vertex}));
  if (corner.outward.isZero(0.0)) {
    corner.kind = CornerKind::FOLDED;
    // The fan from `outward` to the polygon of normals covers the sphere with the winding numbers,
    // less their value at the opposite: its area is the angle defect (Gauss and Bonnet).
    corner.outward = surface.pseudo_normal({FeatureKind::VERTEX, vertex});
    double area = 0.0;
    for (std::size_t k = 0; k < normals.size(); ++k)
      area += signed_area(corner.outward, normals[(k + normals.size() - 1) % normals.size()], normals[k]);
    const double whole = 4.0 * std::numbers::pi;
    corner.away = static_cast<int>(std::lround((2.0 * std::numbers::pi - whole_angle - area) / whole));
  }
  corners[static_cast<std::size_t>(vertex)] = corner;
}

std::size_t SignedFeatures::bytes() const {
  return chains.capacity() * sizeof(Chain) + corners.capacity() * sizeof(Corner) +
         (others.capacity() + regions.capacity()) * sizeof(std::int32_t) + inner.capacity() * sizeof(Vec3);
}

}  // namespace lmdbench
