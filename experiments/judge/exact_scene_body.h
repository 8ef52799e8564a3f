// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <cstdint>
#include <vector>

namespace lmdbench::exact {

/// Sine below which rounding decides an outer side or a triangle's area.
inline constexpr double UNCERTAIN_SINE = 1e-9;

/// One mesh of the scene with its vertices in the world as RigidTransform rounds them; from here on
/// they are exact.
class WorldBody {
 public:
  WorldBody(const Surface& surface, const RigidTransform& X_WS);

  const Surface& surface() const { return surface_; }
  const std::vector<Vec3>& vertices_W() const { return vertices_W_; }
  const Vec3& vertex(std::int32_t index) const { return vertices_W_[static_cast<std::size_t>(index)]; }
  const auto& corners(std::int32_t triangle) const {
    return surface_.mesh.triangles[static_cast<std::size_t>(triangle)];
  }
  const auto& ends(std::int32_t edge) const {
    return surface_.adjacency.edges[static_cast<std::size_t>(edge)];
  }
  Triangle triangle(std::int32_t index) const;

  /// Whether the feature has an outer side; boundary and non-manifold features have none.
  bool has_side(const FeatureId& feature) const;
  /// Whether an incident triangle has (almost) no area: several of its features then share each
  /// point, and any of them may carry it.
  bool on_flat_triangle(const FeatureId& feature) const;
  /// Whether the direction leaves a vertex on the side of its pseudo-normal, the angle-weighted sum
  /// of face normals. Only this is judged in long double, because angles are not rational.
  /// @param certain becomes false where rounding decides
  bool on_outer_side_of_vertex(std::int32_t vertex, const Vec3& direction_W, bool& certain) const;

 private:
  const Surface& surface_;
  std::vector<Vec3> vertices_W_;
  std::vector<bool> on_non_manifold_edge_;  ///< #V
};

}  // namespace lmdbench::exact
