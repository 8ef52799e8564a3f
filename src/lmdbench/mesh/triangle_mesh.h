// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Indexed triangle mesh, as in files. In its own frame; unit: metres after scaling, else the
/// file's.
struct TriangleMesh {
  std::vector<Vec3> vertices;                          ///< #V by 3.
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< #T by 3, counter-clockwise from outside.
  /// Distance of the true planes from those of the coordinates, because the file was rounded
  /// (flatten.h); 0 for exact coordinates.
  double planar_tolerance = 0.0;

  Triangle triangle(std::int32_t index) const {
    const auto& corners = triangles[static_cast<std::size_t>(index)];
    return {vertices[static_cast<std::size_t>(corners[0])], vertices[static_cast<std::size_t>(corners[1])],
            vertices[static_cast<std::size_t>(corners[2])]};
  }
  /// Between two vertices.
  Segment segment(const std::array<std::int32_t, 2>& ends) const {
    return {vertices[static_cast<std::size_t>(ends[0])], vertices[static_cast<std::size_t>(ends[1])]};
  }
};

/// Axis-aligned; empty for a mesh without vertices [m].
Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh);

/// Length of the axis-aligned bounding box's diagonal; 0 for a mesh without vertices.
double bounding_box_diagonal(const TriangleMesh& mesh);

/// Mean length of all triangle sides; 0 for a mesh without triangles.
double mean_edge_length(const TriangleMesh& mesh);

/// Centre of the axis-aligned bounding box.
Vec3 bounding_box_centre(const TriangleMesh& mesh);

/// Largest distance of a vertex from a point; 0 for a mesh without vertices.
double radius_about(const TriangleMesh& mesh, const Vec3& centre);

}  // namespace lmdbench
