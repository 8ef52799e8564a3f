// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/mesh/flat_triangles.h>
#include <lmdbench/mesh/self_intersections.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/mesh/winding_number.h>
#include <lmdbench/shape/flat_regions.h>

#include <study/completeness/nearest_lmd.h>

#include <cmath>

namespace lmdbench::completeness {
namespace {

/// Whether loading (flatten.h) would flip flat triangles, beside which edges have no LMD.
bool has_t_junctions(TriangleMesh mesh) {
  return flip_flat_triangles(mesh, FLATNESS * lmdbench::largest_coordinate(mesh.vertices)) > 0;
}

bool is_solid(const Body& body, bool by_design) {
  const ValidityReport report = check_mesh(body.surface());
  return report.closed && report.volume.value_or(0.0) > 0.0 && !has_t_junctions(body.surface().mesh) &&
         (by_design || (report.manifold && report.duplicate_triangles == 0 &&
                        self_intersections(body.surface().mesh).pairs == 0));
}

/// Over the size, how deep behind a triangle its solid is looked for: beyond rounding, in plates.
constexpr double DEPTHS[] = {1e-10, 1e-9, 1e-8, 1e-7, 1e-6};

/// Whether the solid is behind a point of the surface; not of a sheet whose sides single precision
/// brought together or through each other, nor of a part that is turned inside out.
bool bounds_solid(const Vec3& point, const Vec3& outwards, const Body& body) {
  for (const double depth : DEPTHS) {
    const double winding = winding_number(point - depth * body.diagonal() * outwards, body.surface().mesh);
    if (std::abs(winding) > 0.9) return winding > 0.0;  // beside slivers it is rounding
  }
  return false;
}

/// In the middle of a triangle, and beside a point of it.
bool bounds_solid(std::int32_t triangle, const Vec3& nearest, const Body& body) {
  const Triangle corners = body.surface().mesh.triangle(triangle);
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0,
             outwards = body.surface().face_normals[static_cast<std::size_t>(triangle)];
  return bounds_solid(middle, outwards, body) &&
         bounds_solid(nearest + 0.01 * (middle - nearest), outwards, body);
}

bool is_outside(const Vec3& point, const TriangleMesh& mesh) {
  return std::abs(winding_number(point, mesh)) < 0.5;
}

}  // namespace

NearestLmds::NearestLmds(const Scene& scene, bool by_design)
    : scene_(scene),
      are_solids_(scene.is_pair() && is_solid(*scene.moving, by_design) &&
                  is_solid(scene.fixed_body(), by_design)) {}

std::optional<NearestLmd> NearestLmds::at(const Pose& X_WM, double cutoff) const {
  if (!are_solids_) return std::nullopt;
  const Body &moving = *scene_.moving, &fixed = scene_.fixed_body();
  const auto lengths = ContactTolerance::of(moving, fixed, RigidTransform(X_WM), cutoff);
  const double tolerance = 2.0 * lengths.known + lengths.rounding;
  const NearestPair nearest = nearest_pair(moving, fixed, X_WM, cutoff);
  if (!(nearest.distance > tolerance && nearest.distance < cutoff - tolerance)) return std::nullopt;
  const RigidTransform X_MW(X_WM.inverse());
  const Vec3 &p_W = nearest.pair.point_a, &q_W = nearest.pair.point_b;
  const Vec3 middle_W = 0.5 * (p_W + q_W);
  if (!is_outside(middle_W, fixed.surface().mesh) ||
      !is_outside(X_MW.point(middle_W), moving.surface().mesh) ||
      !bounds_solid(nearest.triangle_moving, X_MW.point(p_W), moving) ||
      !bounds_solid(nearest.triangle_fixed, q_W, fixed))
    return std::nullopt;
  return NearestLmd{nearest.distance, tolerance};
}

}  // namespace lmdbench::completeness
