// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/hierarchy/wide_node_test.h>

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

    const LaneBounds bounds(node, lane, probe, limits.rounding);
    const bool touch = bounds.squared_distance <= squared(limits.touch + bounds.radii) &&
                       std::abs(bounds.z_probe) <= limits.touch + bounds.slab_probe &&
                       std::abs(bounds.z_lane) <= limits.touch + bounds.slab_lane;
    const bool near = bounds.squared_distance <= squared(limits.cutoff + bounds.radii) &&
                      bounds.z_probe <= limits.cutoff + bounds.slab_probe &&
                      bounds.z_lane <= limits.cutoff + bounds.slab_lane;

    const bool collinear =
        -bounds.between >= bounds.cosine * probe.cosine - bounds.sine * probe.sine - DIRECTION_ROUNDING;

    const float least_squared_distance = bounds.squared_distance * (1.0F - DIRECTION_ROUNDING);
    const float reach_probe = bounds.z_probe + bounds.slab_probe;
    const float reach_lane = bounds.z_lane + bounds.slab_lane;
    const float side_probe =
        bounds.radii * probe.cosine + probe.sine * std::min(reach_probe, limits.cutoff * probe.cosine);
    const float side_lane =
        bounds.radii * bounds.cosine + bounds.sine * std::min(reach_lane, limits.cutoff * bounds.cosine);
    const bool directed =
        reach_probe >= 0.0F && reach_lane >= 0.0F &&
        (least_squared_distance - bounds.z_probe * bounds.z_probe) * squared(probe.cosine) <=
            squared(side_probe) &&
        (least_squared_distance - bounds.z_lane * bounds.z_lane) * squared(bounds.cosine) <=
            squared(side_lane);

    if (touch) masks.touch |= bit;
    if (near && collinear && directed) masks.lmd |= bit;
    if (!touch && !near) masks.beyond |= bit;
    if (!touch && near && !collinear) masks.not_collinear |= bit;
  }
  return masks;
}

}  // namespace lmdbench
