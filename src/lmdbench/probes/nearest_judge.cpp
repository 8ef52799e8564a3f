// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/decision/polar_condition.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/probes/nearest_judge.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

/// The exact kernel's result for named triangles.
struct JudgedPair {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]
  bool owes_lmd = false;  ///< On the outer side of both: an LMD as near must exist.
  ContactTolerance tolerance;
};

bool owes_lmd(const NamedTriangles& named, const TrianglePairDistance& pair, double rounding) {
  const Surface &moving = named.moving.surface(), &fixed = named.fixed.surface();
  const auto has_area = [](const Surface& surface, std::int32_t triangle) {
    return !surface.face_normals[static_cast<std::size_t>(triangle)].isZero(0.0);
  };
  if (!has_area(moving, named.triangle_moving) || !has_area(fixed, named.triangle_fixed)) return false;
  if (pair.intersecting) return true;
  const FeatureId f = moving.feature_of(named.triangle_moving, pair.feature_a);
  const FeatureId g = fixed.feature_of(named.triangle_fixed, pair.feature_b);
  const Eigen::Quaterniond& R_FM = named.X_FM.rotation;
  const Vec3 d = pair.point_b - pair.point_a;
  if (d.norm() > rounding) return is_outer(moving, f, R_FM.conjugate() * d) && is_outer(fixed, g, -d);
  // Near touch d has no direction: use normals that face each other.
  return (R_FM * moving.pseudo_normal(f)).dot(fixed.pseudo_normal(g)) < 0.0;
}

JudgedPair judged(const NamedTriangles& named, double cutoff) {
  JudgedPair result;
  if (named.triangle_moving < 0 || named.triangle_fixed < 0) return result;
  const Surface &moving = named.moving.surface(), &fixed = named.fixed.surface();
  const RigidTransform X_FM(named.X_FM);
  result.tolerance = ContactTolerance::of(named.moving, named.fixed, X_FM, cutoff);
  const TrianglePairDistance pair = triangle_distance(
      X_FM.triangle(moving.mesh.triangle(named.triangle_moving)), fixed.mesh.triangle(named.triangle_fixed));
  result.distance = std::sqrt(pair.squared_distance);
  result.owes_lmd = owes_lmd(named, pair, result.tolerance.rounding);
  return result;
}

}  // namespace

bool contradicts_nearest(double nearest, std::span<const NamedTriangles> named, double cutoff,
                         double tolerance_relative) {
  const double ours = std::isnan(nearest) ? std::numeric_limits<double>::infinity() : nearest;
  double least = std::numeric_limits<double>::infinity(), granted = 0.0;
  bool too_far = false;
  for (const NamedTriangles& two : named) {
    const JudgedPair pair = judged(two, cutoff);
    const double known = 3.0 * pair.tolerance.known + pair.tolerance.rounding;
    if (pair.distance < least) granted = known;
    least = std::min(least, pair.distance);
    const double nearer = pair.distance * (1.0 + tolerance_relative);
    too_far |= pair.owes_lmd && nearer + known < cutoff && ours - pair.tolerance.widest_tie(ours) > nearer;
  }
  return too_far || (ours + granted) * (1.0 + tolerance_relative) < least;
}

}  // namespace lmdbench
