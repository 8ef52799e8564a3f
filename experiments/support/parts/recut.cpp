// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <support/parts/recut.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace lmdbench::parts {
namespace {

using Corners = std::array<std::int32_t, 3>;
/// Share of halved edges; share of edges that a pass turns.
constexpr double HALVED_SHARE = 0.15, TURNED_SHARE = 0.5;
/// Sine up to which four points are flat, and sine that the angles of the new triangles must
/// exceed: no needles.
constexpr double FLAT = 1e-13, ANGLE = 0.05;

/// Both triangles of an edge and their corners off it: from `from` to `to` in the left one.
struct Diamond {
  std::size_t left, right;
  std::int32_t from, to, left_tip, right_tip;
};

template <typename Element>
void shuffle(std::vector<Element>& elements, experiments::Random& random) {
  for (std::size_t i = elements.size(); i > 1; --i) std::swap(elements[i - 1], elements[random.index(i)]);
}

/// The diamonds of all edges of two triangles, in random order.
std::vector<Diamond> diamonds(const TriangleMesh& mesh, experiments::Random& random) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::size_t, std::int32_t>> side;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      side[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = {t, mesh.triangles[t][(i + 2) % 3]};
  std::vector<Diamond> result;
  for (const auto& [ends, left] : side) {
    if (ends.first > ends.second) continue;
    const auto right = side.find({ends.second, ends.first});
    if (right == side.end()) continue;
    result.push_back(
        {left.first, right->second.first, ends.first, ends.second, left.second, right->second.second});
  }
  shuffle(result, random);
  return result;
}

/// Visits diamonds that share no triangle with one changed before.
template <typename Change>
void for_some(TriangleMesh& mesh, double share, experiments::Random& random, const Change& change) {
  std::vector<bool> changed(mesh.triangles.size(), false);
  for (const Diamond& d : diamonds(mesh, random)) {
    if (changed[d.left] || changed[d.right] || !(random.uniform() < share)) continue;
    if (change(d)) changed[d.left] = changed[d.right] = true;
  }
}

bool can_turn(const TriangleMesh& mesh, const Diamond& d) {
  const auto at = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
  const Vec3 a = at(d.from), b = at(d.to), l = at(d.left_tip), r = at(d.right_tip);
  const Vec3 n = (b - a).cross(l - a), m = (a - b).cross(r - b);
  // Coplanar, equally oriented, and a strictly convex quadrilateral.
  if (!(n.cross(m).norm() <= FLAT * n.norm() * m.norm() && n.dot(m) > 0.0)) return false;
  if (!(std::abs(n.dot(r - a)) <= FLAT * n.norm() * (r - a).norm())) return false;
  const auto turns_left = [&](const Vec3& p, const Vec3& q, const Vec3& s) {
    return n.normalized().dot((q - p).cross(s - q)) > ANGLE * (q - p).norm() * (s - q).norm();
  };
  return turns_left(r, b, l) && turns_left(l, a, r);
}

}  // namespace

TriangleMesh recut(TriangleMesh mesh, experiments::Random& random) {
  const std::vector<Vec3>& vertices = mesh.vertices;
  const std::size_t before = vertices.size();
  while (vertices.size() == before)
    for_some(mesh, HALVED_SHARE, random, [&](const Diamond& d) {
      const auto middle = static_cast<std::int32_t>(vertices.size());
      const Vec3 between =
          0.5 * (vertices[static_cast<std::size_t>(d.from)] + vertices[static_cast<std::size_t>(d.to)]);
      mesh.vertices.push_back(between);
      mesh.triangles[d.left] = {d.from, middle, d.left_tip};
      mesh.triangles[d.right] = {d.to, middle, d.right_tip};
      mesh.triangles.push_back({middle, d.to, d.left_tip});
      mesh.triangles.push_back({middle, d.from, d.right_tip});
      return true;
    });
  return reordered(other_diagonals(std::move(mesh), random), random);
}

TriangleMesh other_diagonals(TriangleMesh mesh, experiments::Random& random) {
  for (int pass = 0; pass < 3; ++pass) {
    for_some(mesh, TURNED_SHARE, random, [&](const Diamond& d) {
      if (!can_turn(mesh, d)) return false;
      mesh.triangles[d.left] = {d.left_tip, d.right_tip, d.to};
      mesh.triangles[d.right] = {d.right_tip, d.left_tip, d.from};
      return true;
    });
  }
  return mesh;
}

TriangleMesh reordered(TriangleMesh mesh, experiments::Random& random) {
  const std::vector<Vec3>& vertices = mesh.vertices;
  std::vector<std::size_t> order(vertices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  shuffle(order, random);
  TriangleMesh result;
  result.planar_tolerance = mesh.planar_tolerance;
  std::vector<std::int32_t> number(order.size());
  for (const std::size_t v : order) {
    number[v] = static_cast<std::int32_t>(result.vertices.size());
    result.vertices.push_back(vertices[v]);
  }
  result.triangles = mesh.triangles;
  for (Corners& corners : result.triangles) {
    for (std::int32_t& corner : corners) corner = number[static_cast<std::size_t>(corner)];
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.index(3)),
                corners.end());
  }
  shuffle(result.triangles, random);
  return result;
}

}  // namespace lmdbench::parts
