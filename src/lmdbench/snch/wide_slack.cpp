// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/wide_slack.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/snch/wide_slack.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/snch/wide_vectors-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The same operations in the same order as test_lanes_slack_scalar.
HWY_INLINE WideSlackMasks test_slack(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                     const WidePaces& paces, std::uint32_t touch_lanes) {
  const Lanes f;
  const hn::RebindToUnsigned<Lanes> u;
  const auto squared = [](auto x) HWY_ATTR { return hn::Mul(x, x); };
  const auto zero = hn::Zero(f);
  const auto one = hn::Set(f, 1.0F);
  const auto rounding = hn::Set(f, limits.rounding);
  const auto cutoff = hn::Set(f, limits.cutoff);
  const auto touch_limit = hn::Set(f, limits.touch);
  const auto direction_rounding = hn::Set(f, DIRECTION_ROUNDING);
  const auto probe_axis_x = hn::Set(f, probe.axis[0]);
  const auto probe_axis_y = hn::Set(f, probe.axis[1]);
  const auto probe_axis_z = hn::Set(f, probe.axis[2]);
  const auto probe_radius = hn::Set(f, probe.radius);
  const auto probe_thickness = hn::Set(f, probe.thickness);
  const auto probe_cosine = hn::Set(f, probe.cosine);
  const auto probe_sine = hn::Set(f, probe.sine);
  const auto horizon_lanes = hn::Set(f, paces.horizon);
  const auto per_metre = hn::Set(f, paces.frames_per_metre);
  const auto per_radian = hn::Set(f, paces.frames_per_radian);
  const auto infinite = hn::Set(f, std::numeric_limits<float>::infinity());
  const auto half_diagonal = hn::Set(f, 0.7F);
  auto least_length = infinite, least_angle = infinite;
  alignas(32) static constexpr std::uint32_t LANE_BITS[WIDE_WIDTH] = {1, 2, 4, 8, 16, 32, 64, 128};

  WideSlackMasks masks;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += static_cast<std::uint32_t>(hn::Lanes(f))) {
    const auto dx = hn::Sub(hn::Load(f, node.centre[0] + first), hn::Set(f, probe.centre[0]));
    const auto dy = hn::Sub(hn::Load(f, node.centre[1] + first), hn::Set(f, probe.centre[1]));
    const auto dz = hn::Sub(hn::Load(f, node.centre[2] + first), hn::Set(f, probe.centre[2]));
    const auto ux = hn::Load(f, node.axis[0] + first);
    const auto uy = hn::Load(f, node.axis[1] + first);
    const auto uz = hn::Load(f, node.axis[2] + first);
    const auto squared_distance = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    const auto z_probe =
        hn::Add(hn::Add(hn::Mul(dx, probe_axis_x), hn::Mul(dy, probe_axis_y)), hn::Mul(dz, probe_axis_z));
    const auto z_lane = hn::Neg(hn::Add(hn::Add(hn::Mul(dx, ux), hn::Mul(dy, uy)), hn::Mul(dz, uz)));
    const auto between =
        hn::Add(hn::Add(hn::Mul(ux, probe_axis_x), hn::Mul(uy, probe_axis_y)), hn::Mul(uz, probe_axis_z));
    const auto across =
        hn::Sqrt(hn::Add(hn::Max(hn::Sub(one, hn::Mul(between, between)), zero), direction_rounding));
    const auto along = hn::Abs(between);
    const auto radius = hn::Load(f, node.radius + first);
    const auto thickness = hn::Load(f, node.thickness + first);
    const auto radii = hn::Add(hn::Add(radius, probe_radius), rounding);
    const auto slab_probe = hn::Add(hn::Add(probe_thickness, rounding),
                                    hn::Add(hn::Mul(thickness, along), hn::Mul(radius, across)));
    const auto slab_lane = hn::Add(hn::Add(thickness, rounding),
                                   hn::Add(hn::Mul(probe_thickness, along), hn::Mul(probe_radius, across)));
    const auto cosine = hn::Load(f, node.cosine + first);
    const auto sine = hn::Load(f, node.sine + first);

    const auto least_squared_distance = hn::Mul(squared_distance, hn::Set(f, 1.0F - DIRECTION_ROUNDING));
    const auto distance = hn::Sqrt(least_squared_distance);
    const auto apart = hn::Sub(distance, radii);
    const auto apart_probe = hn::Sub(z_probe, slab_probe);
    const auto apart_lane = hn::Sub(z_lane, slab_lane);
    const auto reach_probe = hn::Add(z_probe, slab_probe);
    const auto reach_lane = hn::Add(z_lane, slab_lane);
    // |z| - slab is the larger of z - slab and -z - slab.
    const auto touch_slack = hn::Sub(hn::Max(apart, hn::Max(hn::Max(apart_probe, hn::Neg(reach_probe)),
                                                            hn::Max(apart_lane, hn::Neg(reach_lane)))),
                                     touch_limit);

    const auto g1 = hn::Sub(hn::Max(apart, hn::Max(apart_probe, apart_lane)), cutoff);
    const auto g2_cosines = hn::Add(
        hn::Sub(hn::Sub(hn::Mul(cosine, probe_cosine), hn::Mul(sine, probe_sine)), direction_rounding),
        between);
    const auto g2 = hn::Div(g2_cosines, hn::IfThenElse(hn::Le(between, zero), across, one));
    const auto side_probe = hn::Add(hn::Mul(radii, probe_cosine),
                                    hn::Mul(probe_sine, hn::Min(reach_probe, hn::Mul(cutoff, probe_cosine))));
    const auto side_lane =
        hn::Add(hn::Mul(radii, cosine), hn::Mul(sine, hn::Min(reach_lane, hn::Mul(cutoff, cosine))));
    const auto lateral_probe =
        hn::Mul(hn::Sqrt(hn::Max(hn::Sub(least_squared_distance, squared(z_probe)), zero)), probe_cosine);
    const auto lateral_lane =
        hn::Mul(hn::Sqrt(hn::Max(hn::Sub(least_squared_distance, squared(z_lane)), zero)), cosine);
    const auto g3 =
        hn::Max(hn::Max(hn::Neg(reach_probe), hn::Neg(reach_lane)),
                hn::Mul(hn::Max(hn::Sub(lateral_probe, side_probe), hn::Sub(lateral_lane, side_lane)),
                        half_diagonal));
    const auto length_slack = hn::Max(g1, g3);
    const auto length_frames = hn::Mul(length_slack, per_metre);
    const auto angle_frames = hn::Mul(g2, per_radian);
    const auto by_length = hn::Ge(length_frames, angle_frames);

    const auto used = hn::RebindMask(f, hn::Ne(hn::Load(u, node.child + first), hn::Zero(u)));
    const auto touch_matters = hn::RebindMask(
        f, hn::Ne(hn::And(hn::Load(u, LANE_BITS + first), hn::Set(u, touch_lanes)), hn::Zero(u)));
    const auto lmd = hn::And(used, hn::Le(hn::Max(length_frames, angle_frames), horizon_lanes));
    const auto touch =
        hn::And(hn::And(used, touch_matters), hn::Le(hn::Mul(touch_slack, per_metre), horizon_lanes));
    masks.used |= mask_bits(f, used, first);
    masks.lmd |= mask_bits(f, lmd, first);
    masks.touch |= mask_bits(f, touch, first);
    const auto dead = hn::AndNot(lmd, used);
    const auto touch_dead = hn::AndNot(touch, hn::And(used, touch_matters));
    least_length = hn::Min(least_length, hn::IfThenElse(hn::And(dead, by_length), length_slack, infinite));
    least_length = hn::Min(least_length, hn::IfThenElse(touch_dead, touch_slack, infinite));
    least_angle = hn::Min(least_angle, hn::IfThenElse(hn::AndNot(by_length, dead), g2, infinite));
  }
  masks.length_slack = hn::GetLane(hn::MinOfLanes(f, least_length));
  masks.angle_slack = hn::GetLane(hn::MinOfLanes(f, least_angle));
  return masks;
}

void TestSlack(const WideNode& node, const WideProbe& probe, const WideLimits& limits, const WidePaces& paces,
               std::uint32_t touch_lanes, WideSlackMasks& masks) {
  masks = test_slack(node, probe, limits, paces, touch_lanes);
}

/// Nothing here depends on an earlier test, so that a processor works on several at once.
void TestBatch(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
               std::vector<WideKeptTest>& tests) {
  for (WideKeptTest& test : tests) {
    const WideOpening opening = choose_opening(a, b, test.slot_a, test.slot_b);
    const bool open_a = opening.open_a;
    const std::uint32_t home_slot = open_a ? test.slot_b : test.slot_a;
    const WideNode& home = (open_a ? b : a).nodes[home_slot / WIDE_WIDTH];
    const std::uint32_t home_lane = home_slot % WIDE_WIDTH;
    const WideNode& node = (open_a ? a : b).nodes[opening.node];
    const WideProbe probe = make_probe_vector(home, home_lane, open_a ? query.b_in_a : query.a_in_b);
    const WideRef probe_ref = WideRef::from_bits(home.child[home_lane]);
    const KindBits kinds = kind_bits(node);
    // What can only touch matters for faces alone.
    const bool may_touch = !probe_ref.is_feature() || probe_ref.is_face();
    const std::uint32_t touch_lanes = may_touch ? kinds.faces | (0xFFu & ~kinds.features) : 0u;
    const WideSlackMasks masks = test_slack(node, probe, query.limits, test.paces, touch_lanes);
    const std::uint32_t final_lanes = probe_ref.is_feature() ? kinds.features : 0u;
    test.opening = opening;
    test.used = masks.used;
    test.opened = (masks.lmd | masks.touch) & ~final_lanes;
    test.lmd = masks.lmd & final_lanes;
    test.touch = masks.touch & final_lanes;
    test.length_slack = masks.length_slack;
    test.angle_slack = masks.angle_slack;
  }
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(TestSlack);
HWY_EXPORT(TestBatch);

void test_batch(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                std::vector<WideKeptTest>& tests) {
  HWY_DYNAMIC_DISPATCH(TestBatch)(a, b, query, tests);
}

WideSlackMasks test_lanes_slack(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                const WidePaces& paces, std::uint32_t touch_lanes) {
  WideSlackMasks masks;
  HWY_DYNAMIC_DISPATCH(TestSlack)(node, probe, limits, paces, touch_lanes, masks);
  return masks;
}

WideSlackMasks test_lanes_slack_scalar(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                       const WidePaces& paces, std::uint32_t touch_lanes) {
  WideSlackMasks masks;
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
    const float cosine = node.cosine[lane], sine = node.sine[lane];
    const float radii = (radius + probe.radius) + limits.rounding;
    const float slab_probe = (probe.thickness + limits.rounding) + (thickness * along + radius * across);
    const float slab_lane = (thickness + limits.rounding) + (probe.thickness * along + probe.radius * across);

    const float least_squared_distance = squared_distance * (1.0F - DIRECTION_ROUNDING);
    const float apart = std::sqrt(least_squared_distance) - radii;
    const float apart_probe = z_probe - slab_probe, apart_lane = z_lane - slab_lane;
    const float reach_probe = z_probe + slab_probe, reach_lane = z_lane + slab_lane;
    const float touch_slack =
        std::max({apart, apart_probe, -reach_probe, apart_lane, -reach_lane}) - limits.touch;
    const float g1 = std::max({apart, apart_probe, apart_lane}) - limits.cutoff;
    const float g2 = ((cosine * probe.cosine - sine * probe.sine) - DIRECTION_ROUNDING + between) /
                     (between <= 0.0F ? across : 1.0F);
    const float side_probe =
        radii * probe.cosine + probe.sine * std::min(reach_probe, limits.cutoff * probe.cosine);
    const float side_lane = radii * cosine + sine * std::min(reach_lane, limits.cutoff * cosine);
    const float lateral_probe =
        std::sqrt(std::max(least_squared_distance - z_probe * z_probe, 0.0F)) * probe.cosine;
    const float lateral_lane = std::sqrt(std::max(least_squared_distance - z_lane * z_lane, 0.0F)) * cosine;
    const float g3 = std::max(
        {-reach_probe, -reach_lane, std::max(lateral_probe - side_probe, lateral_lane - side_lane) * 0.7F});
    const float length_slack = std::max(g1, g3);
    const float length_frames = length_slack * paces.frames_per_metre;
    const float angle_frames = g2 * paces.frames_per_radian;

    const bool touch_matters = (touch_lanes >> lane & 1u) != 0;
    if (std::max(length_frames, angle_frames) <= paces.horizon) {
      masks.lmd |= bit;
    } else if (length_frames >= angle_frames) {
      masks.length_slack = std::min(masks.length_slack, length_slack);
    } else {
      masks.angle_slack = std::min(masks.angle_slack, g2);
    }
    if (touch_matters && touch_slack * paces.frames_per_metre <= paces.horizon) {
      masks.touch |= bit;
    } else if (touch_matters) {
      masks.length_slack = std::min(masks.length_slack, touch_slack);
    }
  }
  return masks;
}

}  // namespace lmdbench

#endif  // HWY_ONCE
