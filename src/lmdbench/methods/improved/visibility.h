// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/improved/options.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace lmdbench {

/// A triangle with what the visibility pre-test reads, all in one frame.
struct ShadedTriangle {
  Triangle corners;
  std::array<Vec3, 3> vertex_normals;  ///< Unit pseudo-normals of the corners.
  Vec3 face_normal;                    ///< Unit, zero for a triangle without area.
};

/// A triangle of a surface, in the surface's frame.
inline ShadedTriangle shaded_triangle(const Surface& surface, std::int32_t triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  const auto& corners = surface.mesh.triangles[t];
  const auto normal = [&](std::size_t k) { return surface.vertex_normal(corners[k]); };
  return {surface.mesh.triangle(triangle), {normal(0), normal(1), normal(2)}, surface.face_normals[t]};
}

inline ShadedTriangle to_world(const ShadedTriangle& t, const RigidTransform& X_WS) {
  return {X_WS.triangle(t.corners),
          {X_WS.direction(t.vertex_normals[0]), X_WS.direction(t.vertex_normals[1]),
           X_WS.direction(t.vertex_normals[2])},
          X_WS.direction(t.face_normal)};
}

/// The visibility pre-test (paper, section 4.1, Fig. 6): `a` is projected on the plane of `b`, and
/// `b` on that of `a`; a pair is culled when projection and triangle are apart in either plane.
///
/// Decision E6, ours: "using the vertex normals for projection" means that each corner moves along
/// its vertex normal to the other plane. A normal parallel to that plane or away from it projects
/// nowhere; then this side culls nothing, nor does it where a corner lies in the plane:
/// triangles of one plane may meet along it. `ORTHOGONAL` projects along the plane's normal; `OFF`
/// culls nothing. No policy is conservative on every mesh: reports state each one's recall.
bool see_each_other(const ShadedTriangle& a, const ShadedTriangle& b, Visibility visibility);

/// One side of the pre-test with what it looks at, for figures.
struct Sight {
  std::optional<Triangle> shadow;  ///< Projection of the seer on the plane of the seen, if any.
  bool overlaps = true;            ///< Whether this side lets the pair pass.
};

/// Default policy: each corner moves along its vertex normal.
Sight sight(const ShadedTriangle& seer, const ShadedTriangle& seen);

}  // namespace lmdbench
