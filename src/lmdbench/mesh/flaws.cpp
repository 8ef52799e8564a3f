// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/mesh/triangle_normal.h>

#include <cassert>

namespace lmdbench {

namespace {

/// Calls `change` with the index of each chosen triangle.
template <typename Change>
void for_chosen(const TriangleMesh& mesh, int every, Change change) {
  assert(every >= 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += static_cast<std::size_t>(every))
    change(static_cast<std::int32_t>(i));
}

std::int32_t add_vertex(TriangleMesh& mesh, const Vec3& place) {
  mesh.vertices.push_back(place);
  return static_cast<std::int32_t>(mesh.vertices.size()) - 1;
}

}  // namespace

TriangleMesh with_holes(const TriangleMesh& mesh, int every) {
  assert(every >= 1);
  TriangleMesh result{mesh.vertices, {}};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (i % static_cast<std::size_t>(every) != 0) result.triangles.push_back(mesh.triangles[i]);
  return result;
}

TriangleMesh with_duplicates(const TriangleMesh& mesh, int every) {
  TriangleMesh result = mesh;
  for_chosen(mesh, every, [&](std::int32_t i) {
    result.triangles.push_back(mesh.triangles[static_cast<std::size_t>(i)]);
  });
  return result;
}

TriangleMesh with_flips(const TriangleMesh& mesh, int every) {
  TriangleMesh result = mesh;
  for_chosen(mesh, every, [&](std::int32_t i) {
    auto& corners = result.triangles[static_cast<std::size_t>(i)];
    std::swap(corners[1], corners[2]);
  });
  return result;
}

TriangleMesh with_fins(const TriangleMesh& mesh, int every, double height) {
  TriangleMesh result = mesh;
  for_chosen(mesh, every, [&](std::int32_t i) {
    const auto [a, b, c] = mesh.triangles[static_cast<std::size_t>(i)];
    const Triangle corners = mesh.triangle(i);
    const double mean_side = ((corners[1] - corners[0]).norm() + (corners[2] - corners[1]).norm() +
                              (corners[0] - corners[2]).norm()) /
                             3.0;
    const Vec3 tip = 0.5 * (corners[0] + corners[1]) + height * mean_side * triangle_normal(corners);
    result.triangles.push_back({a, b, add_vertex(result, tip)});
  });
  return result;
}

TriangleMesh with_zero_areas(const TriangleMesh& mesh, int every) {
  TriangleMesh result = mesh;
  for_chosen(mesh, every, [&](std::int32_t i) {
    const auto [a, b, c] = mesh.triangles[static_cast<std::size_t>(i)];
    const Triangle corners = mesh.triangle(i);
    result.triangles.push_back({b, c, b});
    result.triangles.push_back({a, b, add_vertex(result, 0.5 * (corners[0] + corners[1]))});
    const std::int32_t first = add_vertex(result, corners[2]);
    const std::int32_t second = add_vertex(result, corners[2]);
    result.triangles.push_back({c, first, second});
  });
  return result;
}

}  // namespace lmdbench
