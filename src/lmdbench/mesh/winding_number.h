// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// Number of turns of a closed surface around a point: the sum of its triangles' signed solid
/// angles (Van Oosterom and Strackee 1983) over 4 pi; 0 outside, 1 inside, -1 if it is inside out.
double winding_number(const Vec3& point, const TriangleMesh& mesh);

/// The same for some of the mesh's triangles.
double winding_number(const Vec3& point, const TriangleMesh& mesh, std::span<const std::int32_t> triangles);

/// The same to about 0.05, for many points: far triangles count together, as one dipole (Barill et
/// al. 2018).
class NearWinding {
 public:
  /// @param mesh  outlives this, and keeps its triangles
  NearWinding(const TriangleMesh& mesh, std::vector<std::int32_t> triangles);
  double at(const Vec3& point) const;

 private:
  struct Node {
    Vec3 centre = Vec3::Zero();
    Vec3 area = Vec3::Zero();  ///< Sum of normals times areas.
    double radius = 0.0;
    std::size_t begin = 0, end = 0;
    std::size_t second = 0;  ///< Child behind the first, which comes next; 0: none.
  };
  void build(std::size_t begin, std::size_t end);
  double angle(std::size_t node, const Vec3& point) const;

  const TriangleMesh* mesh_;
  std::vector<std::int32_t> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace lmdbench
