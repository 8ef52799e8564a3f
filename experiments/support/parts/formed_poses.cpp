// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <support/parts/chances.h>
#include <support/parts/formed_poses.h>

#include <cmath>
#include <iterator>

namespace lmdbench::parts {
namespace {

using experiments::Random;

Triangle some_triangle(const TriangleMesh& mesh, Random& random) {
  return mesh.triangle(static_cast<std::int32_t>(random.index(mesh.triangles.size())));
}

Vec3 upright(const Triangle& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  return n.norm() > 0.0 ? Vec3(n.normalized()) : Vec3::UnitZ();
}

Pose on_its_seat(Random& random) {
  constexpr int COUNTS[] = {1, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 24, 48};
  const int count = COUNTS[random.index(std::size(COUNTS))];
  const double angle = TAU * static_cast<double>(random.index(static_cast<std::size_t>(count))) / count +
                       tiny(0.3, -14.0, -3.0, random);
  Pose pose;
  if (angle != 0.0) pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  const double tilt = tiny(0.3, -13.0, -3.0, random);
  if (tilt != 0.0) pose.rotation = (Eigen::AngleAxisd(tilt, random.direction()) * pose.rotation).normalized();
  Vec3 way = Vec3::UnitZ();
  if (chance(0.5, random))
    way = chance(0.5, random) ? random.direction() : Vec3::Unit(static_cast<Eigen::Index>(random.index(3)));
  pose.translation = draw_gap(random) * way;
  if (chance(0.3, random)) pose.translation += std::abs(decades(-16.0, -5.0, random)) * random.direction();
  return pose;
}

Pose edge_on_edge(const TriangleMesh& moving, const TriangleMesh& fixed, Random& random) {
  const Triangle on = some_triangle(fixed, random), at = some_triangle(moving, random);
  const Vec3 along = (on[1] - on[0]).stableNormalized(), own = (at[1] - at[0]).stableNormalized();
  // Between the directions in which either edge is likely to be free.
  const Vec3 up = Eigen::AngleAxisd(random.uniform(-0.25, 0.25) * TAU, along) * upright(on);
  const Vec3 down = Eigen::AngleAxisd(random.uniform(-0.25, 0.25) * TAU, own) * upright(at);
  Mat3 of_fixed, of_moving;
  of_fixed << along, up.cross(along), up;
  of_moving << own, (-down).cross(own), -down;
  Pose pose;
  pose.rotation = Eigen::Quaterniond(Mat3(of_fixed * of_moving.transpose())).normalized();
  if (!chance(0.4, random)) {
    const double angle = chance(0.5, random) ? TAU * random.uniform() : tiny(0.8, -14.0, -2.0, random);
    pose.rotation = (Eigen::AngleAxisd(angle, up) * pose.rotation).normalized();
  }
  const double u = chance(0.3, random) ? 0.0 : random.uniform(),
               v = chance(0.3, random) ? 0.0 : random.uniform();
  pose.translation =
      on[0] + u * (on[1] - on[0]) + draw_gap(random) * up - pose.rotation * Vec3(at[0] + v * (at[1] - at[0]));
  return pose;
}

Pose corner_on_point(const TriangleMesh& moving, const TriangleMesh& fixed, Random& random) {
  const Triangle on = some_triangle(fixed, random);
  Pose pose;
  pose.rotation = random.rotation();
  const Vec3 way = chance(0.5, random) ? upright(on) : random.direction();
  pose.translation = point_of(on, random) + draw_gap(random) * way -
                     pose.rotation * moving.vertices[random.index(moving.vertices.size())];
  return pose;
}

}  // namespace

Vec3 point_of(const Triangle& t, Random& random) {
  const std::size_t i = random.index(3);
  const double kind = random.uniform(), u = kind < 0.3 ? 0.0 : random.uniform();
  const double v = kind < 0.6 ? 0.0 : (1.0 - u) * random.uniform();
  return t[i] + u * (t[(i + 1) % 3] - t[i]) + v * (t[(i + 2) % 3] - t[i]);
}

Pose face_on_face(const TriangleMesh& moving, const TriangleMesh& fixed, Random& random) {
  const Triangle on = some_triangle(fixed, random), at = some_triangle(moving, random);
  const Vec3 up = upright(on);
  Pose pose;
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(upright(at), -up);
  if (chance(0.5, random)) {
    // A side along a side.
    const Vec3 way = pose.rotation * (at[1] - at[0]), along = on[1] - on[0];
    pose.rotation =
        Eigen::AngleAxisd(
            std::atan2(way.cross(along).dot(up), way.dot(along)) + tiny(0.5, -14.0, -4.0, random), up) *
        pose.rotation;
  } else {
    pose.rotation = Eigen::AngleAxisd(TAU * random.uniform(), up) * pose.rotation;
  }
  const double tilt = tiny(0.6, -13.0, -3.0, random);
  if (tilt != 0.0) pose.rotation = Eigen::AngleAxisd(tilt, random.direction()) * pose.rotation;
  pose.rotation.normalize();
  const double offset = tiny(0.5, -16.0, -5.0, random);
  pose.translation = point_of(on, random) + draw_gap(random) * up + offset * random.direction() -
                     pose.rotation * point_of(at, random);
  return pose;
}

Pose formed_pose(const TriangleMesh& moving, const TriangleMesh& fixed, Random& random) {
  const double kind = random.uniform();
  if (kind < 0.35) return on_its_seat(random);
  if (kind < 0.65) return face_on_face(moving, fixed, random);
  if (kind < 0.85) return edge_on_edge(moving, fixed, random);
  return corner_on_point(moving, fixed, random);
}

}  // namespace lmdbench::parts
