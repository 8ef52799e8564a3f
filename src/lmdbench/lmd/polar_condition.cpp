// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/polar_condition.h>
#include <lmdbench/mesh/polar_cone.h>

namespace lmdbench {

namespace {

bool admits_wing(const Vec3& u, const Vec3& wing, const PolarSlack& slack) {
  const double along = u.dot(wing);
  return along <= slack.length || along <= slack.length + slack.sine * wing.norm();
}

/// The outer side is asked for last: whether a vertex has one costs a walk round it.
bool is_outer(const Surface& surface, const FeatureId& feature, const Vec3& u_S) {
  return u_S.dot(surface.pseudo_normal(feature)) > 0.0 || !has_outer_side(surface, feature);
}

}  // namespace

bool corner_admits(const ShapeSide& side, std::int32_t vertex, const Vec3& u_W, const PolarSlack& slack) {
  return !corner_leads_down(side, vertex, u_W, slack) &&
         is_outer(side.surface, {FeatureKind::VERTEX, vertex}, side.direction_to_surface(u_W));
}

bool chain_admits(const ShapeSide& side, std::int32_t chain, const Vec3& u_W, const PolarSlack& slack) {
  return !chain_leads_down(side, chain, u_W, slack) &&
         is_outer(side.surface, {FeatureKind::EDGE, side.shape.lead_of_chain(chain)},
                  side.direction_to_surface(u_W));
}

bool corner_leads_down(const ShapeSide& side, std::int32_t vertex, const Vec3& u_W, const PolarSlack& slack) {
  const Vec3 u_S = side.direction_to_surface(u_W);
  return !side.shape.for_each_corner_wing(side.surface, vertex,
                                          [&](const Vec3& wing) { return admits_wing(u_S, wing, slack); });
}

bool chain_leads_down(const ShapeSide& side, std::int32_t chain, const Vec3& u_W, const PolarSlack& slack) {
  const Vec3 u_S = side.direction_to_surface(u_W);
  return !side.shape.for_each_chain_wing(side.surface, chain,
                                         [&](const Vec3& wing) { return admits_wing(u_S, wing, slack); });
}

}  // namespace lmdbench
