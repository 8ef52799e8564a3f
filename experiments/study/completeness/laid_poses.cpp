// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <study/completeness/laid_poses.h>
#include <support/parts/chances.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace lmdbench::completeness {
namespace {

using experiments::Random;
using parts::chance;
using parts::power_of_ten;

/// From any corner on.
Triangle some_corners(const TriangleMesh& mesh, Random& random) {
  Triangle triangle = mesh.triangle(static_cast<std::int32_t>(random.index(mesh.triangles.size())));
  std::ranges::rotate(triangle, triangle.begin() + static_cast<std::ptrdiff_t>(random.index(3)));
  return triangle;
}

/// Along the first edge; any direction where it has no length.
Vec3 along(const Triangle& corners) {
  const Vec3 edge = corners[1] - corners[0];
  return edge.isZero(0.0) ? Vec3::UnitX() : edge.stableNormalized();
}

/// First axis along the first edge, third along the normal.
Mat3 frame_of(const Triangle& corners, bool is_turned_over) {
  const Vec3 x = along(corners);
  Vec3 z = x.cross(corners[2] - corners[0]);
  z = z.isZero(1e-12) ? x.unitOrthogonal() : z.normalized();
  if (is_turned_over) z = -z;
  Mat3 frame;
  frame << x, z.cross(x), z;
  return frame;
}

/// Axes to axes.
Mat3 some_axes(Random& random) {
  std::array<Eigen::Index, 3> axes{0, 1, 2};
  for (const std::size_t last : {2u, 1u}) std::swap(axes[last], axes[random.index(last + 1)]);
  Mat3 turn = Mat3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k)
    turn(k, axes[static_cast<std::size_t>(k)]) = chance(0.5, random) ? 1.0 : -1.0;
  if (turn.determinant() < 0.0) turn.row(2) *= -1.0;
  return turn;
}

}  // namespace

Pose laid_pose(const TriangleMesh& moving, const TriangleMesh& fixed, Random& random) {
  const Triangle from = some_corners(moving, random), to = some_corners(fixed, random);
  const std::size_t kind = random.index(5);
  Mat3 turn =
      kind == 0 ? some_axes(random) : Mat3(frame_of(to, kind == 1) * frame_of(from, false).transpose());
  if (kind >= 3)
    turn = Eigen::AngleAxisd(random.uniform(-std::numbers::pi, std::numbers::pi), along(to)) * turn;
  Pose pose;
  pose.rotation = Eigen::Quaterniond(turn).normalized();
  pose.translation = to[0] - pose.rotation * from[0];
  if (chance(1.0 / 3.0, random)) pose.translation += random.uniform() * (to[1] - to[0]);
  if (chance(1.0 / 3.0, random)) pose.translation += power_of_ten(-17.0, -2.0, random) * random.direction();
  return pose;
}

Pose laid_on_itself(const TriangleMesh& mesh, Random& random) {
  Pose pose;
  if (chance(0.1, random)) return pose;
  const auto some_vertex = [&]() -> const Vec3& { return mesh.vertices[random.index(mesh.vertices.size())]; };
  const Vec3 &from = some_vertex(), &to = some_vertex();
  const Vec3 line = chance(0.5, random) ? Vec3(to - from) : random.direction();
  if (chance(0.7, random) && !line.isZero(0.0))
    pose.rotation =
        Eigen::Quaterniond(Eigen::AngleAxisd(power_of_ten(-17.0, -1.0, random), line.stableNormalized()));
  pose.translation = (chance(0.8, random) ? from : to) - pose.rotation * from;
  if (chance(0.5, random)) pose.translation += power_of_ten(-17.0, -1.0, random) * line;
  return pose;
}

}  // namespace lmdbench::completeness
