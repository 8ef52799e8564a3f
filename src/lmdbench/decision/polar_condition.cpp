// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/polar_condition.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lmdbench {

namespace {

bool admits_wing(const Vec3& u, const Vec3& wing, const PolarSlack& slack) {
  const double along = u.dot(wing);
  return slack.sine >= 0.0 && along <= slack.length ? true : along <= slack.length + slack.sine * wing.norm();
}

/// Corners of more wings keep the direction they have: every two wings give one to try.
constexpr std::size_t MOST_WINGS = 64;
/// Where two slacks meet, at most so many times as far off as either, for planes at >= 30 degrees.
constexpr double CORNER_OF_SLACKS = 4.0;
/// Parts of the way back to u from the nearest direction between planes that are tried.
constexpr double LEAST_SHARE = 1.0 / 128.0;
/// Sine of the angle between two planes below which they have no direction in common.
constexpr double PARALLEL = 1e-14;

/// Appends unit normals of the planes that bound the polar cone of a corner or chain, world.
void append_bounds(const ShapeSide& side, const FeatureId& feature, std::vector<Vec3>& bounds) {
  const auto add = [&](const Vec3& wing) {
    if (wing.squaredNorm() > 0.0) bounds.push_back(side.direction(wing).normalized());
    return bounds.size() <= MOST_WINGS;
  };
  if (feature.kind == FeatureKind::EDGE) {
    const auto& ends = side.shape.ends_of_chain(feature.index);
    add(side.vertex_S(ends[1]) - side.vertex_S(ends[0]));
  }
  side.shape.for_each_wing(side.surface, feature, add);
}

/// `admits`, for a direction that is square to a chain up to `tilt`.
bool admits_about(const ShapeSide& side, const FeatureId& feature, const Vec3& u_W, double rounding,
                  double tilt) {
  if (feature.kind == FeatureKind::EDGE) {
    const auto& ends = side.shape.ends_of_chain(feature.index);
    const Vec3 along = side.direction(side.vertex_S(ends[1]) - side.vertex_S(ends[0]));
    if (!(std::abs(u_W.dot(along)) <= rounding + tilt * along.norm())) return false;
  }
  return admits(side, feature, u_W, {rounding, 0.0});
}

bool admits_strictly(const ShapeSide& side, const FeatureId& feature, const Vec3& u_W, double sine) {
  return !leads_down(side, feature, u_W, {-std::numeric_limits<double>::min(), -sine});
}

}  // namespace

bool is_outer(const Surface& surface, const FeatureId& feature, const Vec3& u_S) {
  return u_S.dot(surface.pseudo_normal(feature)) > 0.0 || !surface.has_outer_side(feature);
}

std::optional<KnownDirection> common_direction(const ShapeSide& moving, const FeatureId& f,
                                               const ShapeSide& fixed, const FeatureId& g, const Vec3& u_W,
                                               double error, double rounding, double tilt) {
  LMDBENCH_EXPECTS(is_unit(u_W) && error >= 0.0 && error <= 1.0, "a direction between points at one place");
  std::vector<Vec3> bounds;
  append_bounds(moving, f, bounds);
  append_bounds(fixed, g, bounds);
  if (bounds.size() > MOST_WINGS) return KnownDirection{u_W, error};
  // One or two planes hold a bounding direction of both cones, and the one nearest to u.
  std::vector<Vec3> admitted;
  const auto consider = [&](const Vec3& x) {
    const double length = x.norm();
    const bool is_admitted = length > PARALLEL && admits_about(moving, f, x / length, rounding, tilt) &&
                             admits_about(fixed, g, -x / length, rounding, tilt);
    if (is_admitted) admitted.push_back(x / length);
    return is_admitted;
  };
  consider(u_W);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const Vec3 foot = u_W - u_W.dot(bounds[i]) * bounds[i];
    consider(foot);
    // As far off as u may be, where no other plane comes first (an edge without sides).
    const Vec3 off = error * bounds[i].cross(foot), rest = std::sqrt(1.0 - error * error) * foot;
    consider(rest + off);
    consider(rest - off);
    for (std::size_t k = 0; k < i; ++k) {
      // Square to both as well where their angle is small.
      const Vec3 beside = bounds[k] - bounds[k].dot(bounds[i]) * bounds[i];
      const double sine = beside.norm();
      if (!(sine > PARALLEL)) continue;
      const Vec3 both = bounds[i].cross(beside / sine);
      consider(both);
      consider(-both);
    }
  }
  if (admitted.empty()) return std::nullopt;
  const auto off_u = [&](const Vec3& x) { return (x - u_W).squaredNorm(); };
  KnownDirection known{*std::ranges::min_element(admitted, {}, off_u), 0.0};
  // Each condition holds to the error; both together hold farther away.
  if (error < 1.0 && (known.u - u_W).norm() > CORNER_OF_SLACKS * error) return std::nullopt;
  // Short wings bound little: rounding grants directions far beyond their planes.
  for (double share = 0.5; share > LEAST_SHARE && !consider(known.u + share * (u_W - known.u));) share *= 0.5;
  for (const Vec3& x : admitted) known.error = std::max(known.error, (x - known.u).norm());
  if (error < 1.0) known.error = std::min(known.error, error);
  known.is_strict = admits_strictly(moving, f, known.u, error) && admits_strictly(fixed, g, -known.u, error);
  return known;
}

bool admits(const ShapeSide& side, const FeatureId& feature, const Vec3& u_W, const PolarSlack& slack) {
  if (leads_down(side, feature, u_W, slack)) return false;
  const Vec3 outer = side.shape.outer_side(side.surface, feature);
  return outer.isZero(0.0) || side.direction_to_surface(u_W).dot(outer) > 0.0;
}

bool leads_down(const ShapeSide& side, const FeatureId& feature, const Vec3& u_W, const PolarSlack& slack) {
  LMDBENCH_EXPECTS(is_unit(u_W), "a difference of points that was not divided by its length");
  const Vec3 u_S = side.direction_to_surface(u_W);
  return !side.shape.for_each_wing(side.surface, feature,
                                   [&](const Vec3& wing) { return admits_wing(u_S, wing, slack); });
}

}  // namespace lmdbench
