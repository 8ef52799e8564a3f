// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/original/direction_verification.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench {

DirectionVerification::DirectionVerification(const Surface& surface, double tolerance_rad)
    : surface_(surface),
      tolerance_cosine_(std::cos(tolerance_rad)),
      tolerance_sine_(std::sin(tolerance_rad)),
      accepts_all_(tolerance_rad >= std::numbers::pi) {
  vertex_cosines_.reserve(surface.mesh.vertices.size());
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    double half_angle = 0.0;
    for (const std::int32_t t : surface.adjacency.vertex_triangles[static_cast<std::int32_t>(v)]) {
      const double cosine = surface.vertex_normal(static_cast<std::int32_t>(v))
                                .dot(surface.face_normals[static_cast<std::size_t>(t)]);
      half_angle = std::max(half_angle, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    vertex_cosines_.push_back(std::cos(std::min(half_angle + tolerance_rad, std::numbers::pi)));
  }
}

bool DirectionVerification::accepts(const FeatureId& feature, const Vec3& direction) const {
  if (accepts_all_ || surface_.is_boundary(feature)) return true;
  const auto i = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return direction.dot(surface_.vertex_normal(feature.index)) >= vertex_cosines_[i];
    case FeatureKind::EDGE:
      return edge_accepts(feature.index, direction);
    case FeatureKind::FACE:
      break;
  }
  return direction.dot(surface_.face_normals[i]) >= tolerance_cosine_;
}

bool DirectionVerification::edge_accepts(std::int32_t edge, const Vec3& direction) const {
  const auto triangles = surface_.adjacency.edge_triangles[edge];
  for (const std::int32_t t : triangles)
    if (direction.dot(surface_.face_normals[static_cast<std::size_t>(t)]) >= tolerance_cosine_) return true;
  if (triangles.size() != 2) return false;
  // Between the ends of the arc the angle to it is the one to the plane across the edge.
  const Vec3& first = surface_.face_normals[static_cast<std::size_t>(triangles[0])];
  const Vec3& second = surface_.face_normals[static_cast<std::size_t>(triangles[1])];
  const Vec3 across = first.cross(second);
  const double length = across.norm();
  if (length == 0.0) return false;
  const double out_of_plane = direction.dot(across) / length;
  const Vec3 in_plane = direction - (out_of_plane / length) * across;
  const bool within_arc =
      first.cross(in_plane).dot(across) >= 0.0 && in_plane.cross(second).dot(across) >= 0.0;
  return within_arc && (tolerance_cosine_ <= 0.0 || std::abs(out_of_plane) <= tolerance_sine_);
}

}  // namespace lmdbench
