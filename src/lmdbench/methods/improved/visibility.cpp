// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/improved/visibility.h>

#include <Eigen/Core>

#include <array>

namespace lmdbench {

namespace {

using Vec2 = Eigen::Vector2d;
using Triangle2 = std::array<Vec2, 3>;

/// True when a side of `of` separates the triangles, which do not touch. The third corner tells the
/// inner side, for both orientations.
bool some_side_separates(const Triangle2& of, const Triangle2& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 side = of[(k + 1) % 3] - of[k];
    const auto offset = [&](const Vec2& p) {
      return side.x() * (p.y() - of[k].y()) - side.y() * (p.x() - of[k].x());
    };
    const double inner = offset(of[(k + 2) % 3]);
    if (inner == 0.0) continue;
    const double sign = inner > 0.0 ? 1.0 : -1.0;
    if (sign * offset(other[0]) < 0.0 && sign * offset(other[1]) < 0.0 && sign * offset(other[2]) < 0.0)
      return true;
  }
  return false;
}

/// Corners of `seer` on the plane of `seen`; false where nothing can be said.
template <Visibility VISIBILITY>
bool project(const ShadedTriangle& seer, const ShadedTriangle& seen, Triangle& projected) {
  const Vec3& normal = seen.face_normal;
  if (normal.isZero(0.0)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const double height = (seen.corners[0] - seer.corners[k]).dot(normal);
    if constexpr (VISIBILITY == Visibility::VERTEX_NORMAL) {
      const double approach = seer.vertex_normals[k].dot(normal);
      // Same signs: the ray along the vertex normal meets the plane.
      if (!(height * approach > 0.0)) return false;
      projected[k] = seer.corners[k] + (height / approach) * seer.vertex_normals[k];
    } else {
      projected[k] = seer.corners[k] + height * normal;
    }
  }
  return true;
}

/// Whether coplanar triangles overlap: seen along the axis that their plane faces most.
bool overlap(const Triangle& projected, const ShadedTriangle& seen) {
  Eigen::Index dropped = 0;
  seen.face_normal.cwiseAbs().maxCoeff(&dropped);
  const Eigen::Index u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  Triangle2 shadow, target;
  for (std::size_t k = 0; k < 3; ++k) {
    shadow[k] = {projected[k][u], projected[k][v]};
    target[k] = {seen.corners[k][u], seen.corners[k][v]};
  }
  return !some_side_separates(target, shadow) && !some_side_separates(shadow, target);
}

/// Whether the projection of `seer` on the plane of `seen` overlaps `seen`, or nothing can be said.
template <Visibility VISIBILITY>
bool may_see(const ShadedTriangle& seer, const ShadedTriangle& seen) {
  Triangle projected;
  return !project<VISIBILITY>(seer, seen, projected) || overlap(projected, seen);
}

}  // namespace

bool see_each_other(const ShadedTriangle& a, const ShadedTriangle& b, Visibility visibility) {
  switch (visibility) {
    case Visibility::VERTEX_NORMAL:
      return may_see<Visibility::VERTEX_NORMAL>(a, b) && may_see<Visibility::VERTEX_NORMAL>(b, a);
    case Visibility::ORTHOGONAL:
      return may_see<Visibility::ORTHOGONAL>(a, b) && may_see<Visibility::ORTHOGONAL>(b, a);
    case Visibility::OFF:
      break;
  }
  return true;
}

Sight sight(const ShadedTriangle& seer, const ShadedTriangle& seen) {
  Triangle projected;
  if (!project<Visibility::VERTEX_NORMAL>(seer, seen, projected)) return {};
  return {projected, overlap(projected, seen)};
}

}  // namespace lmdbench
