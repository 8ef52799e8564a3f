// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/flat_triangles.h>
#include <lmdbench/mesh/triangle_normal.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

using Corners = std::array<std::int32_t, 3>;

/// Triangles by their sides, each from corner to corner in the triangle's order.
class Sides {
 public:
  explicit Sides(const std::vector<Corners>& triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) add(triangles[t], t);
  }
  void add(const Corners& corners, std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) triangles_[{corners[k], corners[(k + 1) % 3]}].push_back(triangle);
  }
  void remove(const Corners& corners, std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) std::erase(triangles_[{corners[k], corners[(k + 1) % 3]}], triangle);
  }
  const std::vector<std::size_t>& operator()(std::int32_t from, std::int32_t to) const {
    static const std::vector<std::size_t> none;
    const auto found = triangles_.find({from, to});
    return found == triangles_.end() ? none : found->second;
  }

 private:
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> triangles_;
};

}  // namespace

std::int64_t flip_flat_triangles(TriangleMesh& mesh, double height) {
  const auto position = [&](std::int32_t v) -> const Vec3& {
    return mesh.vertices[static_cast<std::size_t>(v)];
  };
  const auto normal_of = [&](const Corners& corners) {
    return triangle_normal({position(corners[0]), position(corners[1]), position(corners[2])});
  };
  const auto is_flat = [&](const Corners& corners) {
    const Vec3 &a = position(corners[0]), &b = position(corners[1]), &c = position(corners[2]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return normal_of(corners).isZero(0.0) || (b - a).cross(c - a).norm() <= height * longest;
  };
  std::vector<std::size_t> flat;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (is_flat(mesh.triangles[t])) flat.push_back(t);
  if (flat.empty()) return 0;
  Sides sides(mesh.triangles);
  const auto flip = [&](std::size_t t) -> std::optional<std::size_t> {
    Corners& own = mesh.triangles[t];
    const auto length = [&](std::size_t k) { return (position(own[(k + 1) % 3]) - position(own[k])).norm(); };
    const std::size_t longest = std::ranges::max(std::array<std::size_t, 3>{0, 1, 2}, {}, length);
    const std::int32_t a = own[longest], b = own[(longest + 1) % 3], c = own[(longest + 2) % 3];
    const Vec3 along = position(b) - position(a), to_corner = position(c) - position(a);
    const double place = to_corner.dot(along);
    const double end = height * along.norm();
    if (!(place > end && place < along.squaredNorm() - end)) return std::nullopt;
    if (sides(a, b).size() != 1 || sides(b, a).size() != 1) return std::nullopt;
    const std::size_t beyond = sides(b, a).front();
    Corners& other = mesh.triangles[beyond];
    const std::int32_t d = *std::ranges::find_if(other, [&](std::int32_t v) { return v != a && v != b; });
    if (!sides(c, d).empty() || !sides(d, c).empty()) return std::nullopt;
    const Corners to_a{c, a, d}, to_b{d, b, c};
    const Vec3 normal = normal_of(other);
    if (!(normal.dot(normal_of(to_a)) > 0.0 && normal.dot(normal_of(to_b)) > 0.0)) return std::nullopt;
    sides.remove(own, t);
    sides.remove(other, beyond);
    other = to_a;
    own = to_b;
    sides.add(other, beyond);
    sides.add(own, t);
    return beyond;
  };
  // Beyond one flat triangle may lie another one that is flipped first: what waits is asked again.
  std::int64_t flipped = 0;
  std::vector<bool> waits(mesh.triangles.size(), false);
  std::vector<std::size_t> asked(flat.rbegin(), flat.rend());
  while (!asked.empty()) {
    const std::size_t t = asked.back();
    asked.pop_back();
    const std::optional<std::size_t> beyond = flip(t);
    waits[t] = !beyond;
    if (!beyond) continue;
    ++flipped;
    for (const std::size_t changed : {t, *beyond}) {
      const Corners corners = mesh.triangles[changed];
      for (std::size_t k = 0; k < 3; ++k) {
        for (const std::size_t beside : sides(corners[(k + 1) % 3], corners[k])) {
          if (!waits[beside]) continue;
          waits[beside] = false;
          asked.push_back(beside);
        }
      }
    }
  }
  return flipped;
}

}  // namespace lmdbench
