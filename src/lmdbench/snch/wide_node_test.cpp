// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/wide_node_test.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

float squared(float x) {
  return x * x;
}

}  // namespace

WideMasks test_lanes_scalar(const WideNode& node, const WideProbe& probe, const WideLimits& limits) {
  WideMasks masks;
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    if (node.child[lane] == 0) continue;
    const std::uint32_t bit = 1u << lane;
    masks.used |= bit;

    const float dx = node.centre[0][lane] - probe.centre[0];
    const float dy = node.centre[1][lane] - probe.centre[1];
    const float dz = node.centre[2][lane] - probe.centre[2];
    const float ux = node.axis[0][lane], uy = node.axis[1][lane], uz = node.axis[2][lane];
    const float squared_distance = (dx * dx + dy * dy) + dz * dz;
    const float z_probe = (dx * probe.axis[0] + dy * probe.axis[1]) + dz * probe.axis[2];
    const float z_lane = -((dx * ux + dy * uy) + dz * uz);
    const float between = (ux * probe.axis[0] + uy * probe.axis[1]) + uz * probe.axis[2];
    const float across = std::sqrt(std::max(1.0F - between * between, 0.0F) + DIRECTION_ROUNDING);
    const float along = std::abs(between);
    const float radius = node.radius[lane], thickness = node.thickness[lane];
    const float radii = (radius + probe.radius) + limits.rounding;
    const float slab_probe = (probe.thickness + limits.rounding) + (thickness * along + radius * across);
    const float slab_lane = (thickness + limits.rounding) + (probe.thickness * along + probe.radius * across);

    const bool touch = squared_distance <= squared(limits.touch + radii) &&
                       std::abs(z_probe) <= limits.touch + slab_probe &&
                       std::abs(z_lane) <= limits.touch + slab_lane;
    const bool near = squared_distance <= squared(limits.cutoff + radii) &&
                      z_probe <= limits.cutoff + slab_probe && z_lane <= limits.cutoff + slab_lane;

    const float cosine = node.cosine[lane], sine = node.sine[lane];
    const bool collinear = -between >= cosine * probe.cosine - sine * probe.sine - DIRECTION_ROUNDING;

    const float least_squared_distance = squared_distance * (1.0F - DIRECTION_ROUNDING);
    const float reach_probe = z_probe + slab_probe;
    const float reach_lane = z_lane + slab_lane;
    const float side_probe =
        radii * probe.cosine + probe.sine * std::min(reach_probe, limits.cutoff * probe.cosine);
    const float side_lane = radii * cosine + sine * std::min(reach_lane, limits.cutoff * cosine);
    const bool directed =
        reach_probe >= 0.0F && reach_lane >= 0.0F &&
        (least_squared_distance - z_probe * z_probe) * squared(probe.cosine) <= squared(side_probe) &&
        (least_squared_distance - z_lane * z_lane) * squared(cosine) <= squared(side_lane);

    if (touch) masks.touch |= bit;
    if (near && collinear && directed) masks.lmd |= bit;
    if (!touch && !near) masks.beyond |= bit;
    if (!touch && near && !collinear) masks.not_collinear |= bit;
  }
  return masks;
}

}  // namespace lmdbench
