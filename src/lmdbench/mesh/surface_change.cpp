// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/mesh/triangle_normal.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lmdbench {

namespace {

/// Triangles of one task: fewer are not worth a second thread.
constexpr std::size_t FACES_A_TASK = 4096;

}  // namespace

void check_moved_vertices(const std::string& name, const TriangleMesh& mesh, std::span<const Vec3> vertices) {
  if (vertices.size() != mesh.vertices.size())
    throw InputError(
        name, "vertices", fmt::format("{} vertices for a mesh of {}", vertices.size(), mesh.vertices.size()),
        "a deformation keeps the topology: give every vertex of the mesh, in its order; vertices of its "
        "file in one place are one, and those without triangles are none");
  if (vertices.empty()) return;
  // Both reductions are passes without a branch; only an error makes it look for the vertex.
  double sum = 0.0;
  for (const Vec3& p : vertices) sum += 0.0 * (p.x() + p.y() + p.z());
  if (!(sum == 0.0) || !(largest_coordinate(vertices) <= LARGEST_COORDINATE)) {
    const auto bad = std::find_if(vertices.begin(), vertices.end(), [](const Vec3& p) {
      return !(p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= LARGEST_COORDINATE);
    });
    throw InputError(
        name, fmt::format("vertex {}", bad - vertices.begin()),
        fmt::format("coordinates ({}, {}, {}) are no number or too large", bad->x(), bad->y(), bad->z()),
        fmt::format("give finite coordinates of at most {:g}", LARGEST_COORDINATE));
  }
  const bool has_size = std::any_of(vertices.begin(), vertices.end(), [&](const Vec3& p) {
    return (p - vertices.front()).cwiseAbs().maxCoeff() >= SMALLEST_DIAGONAL;
  });
  if (!has_size && bounding_box_diagonal(mesh) >= SMALLEST_DIAGONAL)
    throw InputError(name, "vertices", "all vertices are in one place",
                     "leave the mesh a size: what has none touches nothing in any direction");
}

SurfaceMover::SurfaceMover(const Surface& surface)
    : edge_marks_(surface.adjacency.edges.size(), 0), vertex_marks_(surface.mesh.vertices.size(), 0) {
  change_.face_marks.assign(surface.mesh.triangles.size(), 0);
}

const SurfaceChange& SurfaceMover::move(std::span<const Vec3> vertices, Surface& surface) {
  TriangleMesh& mesh = surface.mesh;
  SurfaceChange& change = change_;
  LMDBENCH_EXPECTS(edge_marks_.size() == surface.adjacency.edges.size() &&
                       change.face_marks.size() == mesh.triangles.size(),
                   "a mover of another surface");
  LMDBENCH_EXPECTS(vertices.size() == mesh.vertices.size(),
                   "vertices that were not checked (check_moved_vertices)");
  change.moved.clear();
  change.faces.clear();
  change.edges.clear();
  change.vertices.clear();
  change.turned_over = change.lost_area = 0;
  change.first_turned_over = change.first_lost_area = -1;
  change.regained_area = false;
  ++change.step;
  double squared_move = 0.0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    // Bit by bit, so that the surface is the one that would be built.
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): 0.0 and -0.0 differ
    if (std::memcmp(&vertices[v], &mesh.vertices[v], sizeof(Vec3)) == 0) continue;
    squared_move = std::max(squared_move, (vertices[v] - mesh.vertices[v]).squaredNorm());
    mesh.vertices[v] = vertices[v];
    change.moved.push_back(static_cast<std::int32_t>(v));
  }
  change.largest_move = std::sqrt(squared_move);
  LMDBENCH_ENSURES(std::ranges::is_sorted(change.moved), "vertices that moved in another order than theirs");

  const auto is_new = [&](std::vector<std::uint32_t>& marks, std::int32_t index) {
    std::uint32_t& mark = marks[static_cast<std::size_t>(index)];
    return mark != change.step && (mark = change.step, true);
  };
  for (const std::int32_t v : change.moved)
    for (const std::int32_t t : surface.adjacency.vertex_triangles[v])
      if (is_new(change.face_marks, t)) change.faces.push_back(t);
  for (const std::int32_t t : surface.adjacency.collapsed)  // in no vertex's row
    if (!change.moved.empty() && is_new(change.face_marks, t)) change.faces.push_back(t);
  normals_.resize(change.faces.size());
  parallel_ranges(change.faces.size(), FACES_A_TASK, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) normals_[i] = triangle_normal(mesh.triangle(change.faces[i]));
  });
  const auto note = [](std::int64_t& count, std::int32_t& first, std::int32_t triangle) {
    ++count;
    if (first < 0 || triangle < first) first = triangle;
  };
  for (std::size_t i = 0; i < change.faces.size(); ++i) {
    const std::int32_t triangle = change.faces[i];
    const auto t = static_cast<std::size_t>(triangle);
    for (const std::int32_t edge : surface.adjacency.triangle_edges[t])
      if (is_new(edge_marks_, edge)) change.edges.push_back(edge);
    for (const std::int32_t vertex : mesh.triangles[t])
      if (is_new(vertex_marks_, vertex)) change.vertices.push_back(vertex);
    Vec3& own = surface.face_normals[t];
    const bool had_area = !own.isZero(0.0), has_area = !normals_[i].isZero(0.0);
    if (had_area && !has_area) note(change.lost_area, change.first_lost_area, triangle);
    if (!had_area && has_area) change.regained_area = true;
    if (own.dot(normals_[i]) < 0.0) note(change.turned_over, change.first_turned_over, triangle);
    own = normals_[i];
  }
  if (!change.vertices.empty()) surface.vertex_normal_is_stale.resize(mesh.vertices.size(), false);
  for (const std::int32_t vertex : change.vertices)
    surface.vertex_normal_is_stale[static_cast<std::size_t>(vertex)] = true;
  return change;
}

}  // namespace lmdbench
