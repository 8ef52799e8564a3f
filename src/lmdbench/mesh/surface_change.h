// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lmdbench {

/// Changes of a surface in one step of a deformation: only vertices move. Indices are unique.
struct SurfaceChange {
  std::vector<std::int32_t> moved;     ///< Vertices whose coordinates changed, ascending.
  std::vector<std::int32_t> faces;     ///< Triangles that have one of them.
  std::vector<std::int32_t> edges;     ///< Of these triangles.
  std::vector<std::int32_t> vertices;  ///< Likewise; edges, faces and these: all with new wings.
  double largest_move = 0.0;           ///< Of a vertex [m].

  /// Triangles whose normal turned by more than a right angle in this step, and the first in the
  /// mesh's order; -1 for none. They are no errors: the vertices define the mesh.
  std::int64_t turned_over = 0;
  std::int32_t first_turned_over = -1;
  /// Triangles that lost their area in this step.
  std::int64_t lost_area = 0;
  std::int32_t first_lost_area = -1;
  bool regained_area = false;  ///< Some triangle without area has one since this step.

  /// Whether a triangle is one of `faces`.
  bool has_face(std::int32_t triangle) const {
    return face_marks[static_cast<std::size_t>(triangle)] == step;
  }
  std::uint32_t step = 0;
  std::vector<std::uint32_t> face_marks;  ///< #T; step in which each was one of `faces` last.
};

/// Checks new vertices of a mesh.
/// @param name of the mesh, for messages
/// @throws InputError for a wrong number of vertices, a coordinate that is not a number or is too
///   large, and vertices that are all in one place
void check_moved_vertices(const std::string& name, const TriangleMesh& mesh, std::span<const Vec3> vertices);

/// Gives a surface new vertices at a cost that grows with the motion: adjacency stays, normals
/// follow where a vertex moved. The result is, bit for bit, that of `build_surface` of its mesh.
class SurfaceMover {
 public:
  explicit SurfaceMover(const Surface& surface);

  /// @pre check_moved_vertices passes
  /// @return valid until the next call
  const SurfaceChange& move(std::span<const Vec3> vertices, Surface& surface);

 private:
  SurfaceChange change_;
  std::vector<std::uint32_t> edge_marks_, vertex_marks_;  ///< Step in which each was listed last.
  std::vector<Vec3> normals_;                             ///< Of change_.faces; scratch.
};

}  // namespace lmdbench
