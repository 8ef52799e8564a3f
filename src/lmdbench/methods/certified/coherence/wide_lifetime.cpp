// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/coherence/wide_lifetime.h>
#include <lmdbench/methods/certified/hierarchy/single_precision.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/coherence/wide_lifetime.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/hierarchy/wide_vectors-inl.h>

#include <hwy/highway.h>

#ifndef LMDBENCH_SNCH_WIDE_LIFETIME_ONCE
#define LMDBENCH_SNCH_WIDE_LIFETIME_ONCE
namespace lmdbench {

/// Tests between the one that is made and the one whose node is fetched.
inline constexpr std::size_t FETCH_DISTANCE = 2;

}  // namespace lmdbench
#endif

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::Vec<Lanes>;

/// A criterion that rejects lanes: how far it is from failing and what it loses in a frame.
struct Criterion {
  Floats slack, loss, value;
};

HWY_INLINE Criterion make_criterion(Floats slack, Floats loss) {
  const Lanes f;
  const auto later = hn::Sub(slack, hn::Mul(loss, hn::Set(f, CHOICE_FRAMES)));
  // What does not reject now is the last choice, however little it loses.
  return {slack, loss,
          hn::IfThenElse(hn::Gt(slack, hn::Zero(f)), later, hn::Sub(slack, hn::Set(f, NO_CHOICE)))};
}

/// The one of two that will reject for longer, roughly.
HWY_INLINE Criterion better(const Criterion& a, const Criterion& b) {
  const auto second = hn::Gt(b.value, a.value);
  return {hn::IfThenElse(second, b.slack, a.slack), hn::IfThenElse(second, b.loss, a.loss),
          hn::Max(a.value, b.value)};
}

/// The same operations in the same order as test_lanes_lifetime_scalar.
HWY_INLINE WideLifetimes test_lifetime(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                       const WideForecast& forecast, const WideLifetimeTest& test) {
  const Lanes f;
  const hn::RebindToUnsigned<Lanes> u;
  const auto squared = [](auto x) HWY_ATTR { return hn::Mul(x, x); };
  const auto zero = hn::Zero(f);
  const auto one = hn::Set(f, 1.0F);
  const auto least = hn::Set(f, LEAST_LENGTH);
  const auto cutoff = hn::Set(f, limits.cutoff);
  const auto direction_rounding = hn::Set(f, DIRECTION_ROUNDING);
  const auto share = hn::Set(f, DEVIATION_SHARE);
  const auto rest = hn::Set(f, 1.0F - DEVIATION_SHARE);
  const auto base = hn::Set(f, forecast.base);
  const auto drift = hn::Set(f, forecast.drift);
  const auto reach = hn::Set(f, forecast.reach);
  const auto horizon = hn::Set(f, forecast.horizon);
  const auto infinite = hn::Set(f, std::numeric_limits<float>::infinity());
  const auto angle_loss = hn::Max(hn::Set(f, forecast.spin * forecast.reach), least);
  const WideTransform& X = forecast.in_moving;
  auto least_frames = infinite, least_budget = infinite;
  alignas(32) static constexpr std::uint32_t LANE_BITS[WIDE_WIDTH] = {1, 2, 4, 8, 16, 32, 64, 128};

  WideLifetimes result;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += static_cast<std::uint32_t>(hn::Lanes(f))) {
    const VectorBounds bounds(node, first, probe, limits.rounding);
    // Motion of the lane's centre against the probe's in a frame, and what nothing is known of but its size.
    auto ex = hn::Set(f, -test.probe_velocity[0]);
    auto ey = hn::Set(f, -test.probe_velocity[1]);
    auto ez = hn::Set(f, -test.probe_velocity[2]);
    auto lever_arm = hn::Set(f, probe.radius + 2.0F * forecast.cutoff);
    if (test.moving_lanes) {
      const auto row = [&](int i) HWY_ATTR {
        return hn::Add(hn::Add(hn::Add(hn::Mul(hn::Set(f, X.columns[0][i]), bounds.cx),
                                       hn::Mul(hn::Set(f, X.columns[1][i]), bounds.cy)),
                               hn::Mul(hn::Set(f, X.columns[2][i]), bounds.cz)),
                       hn::Set(f, X.translation[i]));
      };
      ex = row(0);
      ey = row(1);
      ez = row(2);
      lever_arm = hn::Add(bounds.radius, hn::Set(f, 2.0F * forecast.cutoff));
    }
    const auto extra = hn::Add(hn::Mul(hn::Set(f, forecast.spin), lever_arm), hn::Set(f, forecast.creep));

    const auto z_probe = bounds.z_probe, z_lane = bounds.z_lane;
    const auto growth = VectorBounds::dot(bounds.dx, bounds.dy, bounds.dz, ex, ey, ez);
    const auto rise_probe = VectorBounds::dot(ex, ey, ez, bounds.axis_x, bounds.axis_y, bounds.axis_z);
    const auto rise_lane = hn::Neg(VectorBounds::dot(ex, ey, ez, bounds.ux, bounds.uy, bounds.uz));
    const auto least_squared_distance =
        hn::Mul(bounds.squared_distance, hn::Set(f, 1.0F - DIRECTION_ROUNDING));
    const auto distance = hn::Sqrt(least_squared_distance);
    const auto reach_probe = hn::Add(z_probe, bounds.slab_probe);
    const auto reach_lane = hn::Add(z_lane, bounds.slab_lane);

    const auto lost = [&](auto loss) HWY_ATTR { return hn::Max(hn::Add(loss, extra), least); };
    const Criterion apart = make_criterion(hn::Sub(distance, bounds.radii),
                                           lost(hn::Neg(hn::Div(growth, hn::Max(distance, least)))));
    const Criterion above_probe =
        make_criterion(hn::Sub(z_probe, bounds.slab_probe), lost(hn::Neg(rise_probe)));
    const Criterion above_lane = make_criterion(hn::Sub(z_lane, bounds.slab_lane), lost(hn::Neg(rise_lane)));
    const Criterion below_probe = make_criterion(hn::Neg(reach_probe), lost(rise_probe));
    const Criterion below_lane = make_criterion(hn::Neg(reach_lane), lost(rise_lane));
    const Criterion below = better(below_probe, below_lane);

    const auto beside = [&](auto z, auto rise, auto reached, auto cosine_of, auto sine_of) HWY_ATTR {
      const auto lateral = hn::Sqrt(hn::Max(hn::Sub(least_squared_distance, squared(z)), zero));
      const auto lateral_growth = hn::Div(hn::Sub(growth, hn::Mul(z, rise)), hn::Max(lateral, least));
      const auto limit = hn::Mul(cutoff, cosine_of);
      const auto side = hn::Add(hn::Mul(bounds.radii, cosine_of), hn::Mul(sine_of, hn::Min(reached, limit)));
      const auto side_growth = hn::IfThenElseZero(hn::Lt(reached, limit), hn::Mul(sine_of, rise));
      return make_criterion(
          hn::Mul(hn::Sub(hn::Mul(lateral, cosine_of), side), hn::Set(f, HALF_DIAGONAL)),
          lost(hn::Mul(hn::Sub(side_growth, hn::Mul(lateral_growth, cosine_of)), hn::Set(f, HALF_DIAGONAL))));
    };
    Criterion length =
        better(beside(z_probe, rise_probe, reach_probe, bounds.probe_cosine, bounds.probe_sine),
               beside(z_lane, rise_lane, reach_lane, bounds.cosine, bounds.sine));
    length = better(length, below);
    const auto past = [&](const Criterion& criterion, auto limit) HWY_ATTR {
      return make_criterion(hn::Sub(criterion.slack, limit), criterion.loss);
    };
    const auto farther_than = [&](auto limit) HWY_ATTR {
      return better(better(past(apart, limit), past(above_probe, limit)), past(above_lane, limit));
    };
    length = better(length, farther_than(cutoff));
    const auto touch_limit = hn::Set(f, limits.touch);
    const Criterion touching = better(farther_than(touch_limit),
                                      better(past(below_probe, touch_limit), past(below_lane, touch_limit)));

    const auto g2_cosines = hn::Add(
        hn::Sub(hn::Sub(hn::Mul(bounds.cosine, bounds.probe_cosine), hn::Mul(bounds.sine, bounds.probe_sine)),
                direction_rounding),
        bounds.between);
    const auto angle_slack =
        hn::Mul(hn::Div(g2_cosines, hn::IfThenElse(hn::Le(bounds.between, zero), bounds.across, one)), reach);

    // The share of the slack, the base and the drift are left when the loss has used up the rest.
    const auto frames = [&](auto slack, auto loss) HWY_ATTR {
      return hn::Div(hn::Sub(hn::Mul(slack, rest), base), hn::Add(loss, drift));
    };
    const auto length_frames = frames(length.slack, length.loss);
    const auto angle_frames = frames(angle_slack, angle_loss);
    const auto touch_frames = frames(touching.slack, touching.loss);
    const auto lmd_frames = hn::Max(length_frames, angle_frames);
    const auto lmd_slack = hn::IfThenElse(hn::Ge(length_frames, angle_frames), length.slack, angle_slack);

    const auto used = hn::RebindMask(f, hn::Ne(hn::Load(u, node.child + first), hn::Zero(u)));
    const auto touch_matters = hn::RebindMask(
        f, hn::Ne(hn::And(hn::Load(u, LANE_BITS + first), hn::Set(u, test.touch_lanes)), hn::Zero(u)));
    const auto soon = [&](auto slack, auto loss) HWY_ATTR { return hn::Le(slack, hn::Mul(loss, horizon)); };
    const auto lmd = hn::And(used, hn::And(soon(length.slack, length.loss), soon(angle_slack, angle_loss)));
    const auto touch = hn::And(hn::And(used, touch_matters), soon(touching.slack, touching.loss));
    result.used |= mask_bits(f, used, first);
    result.lmd |= mask_bits(f, lmd, first);
    result.touch |= mask_bits(f, touch, first);
    const auto dead = hn::AndNot(lmd, used);
    const auto touch_dead = hn::AndNot(touch, hn::And(used, touch_matters));
    least_frames = hn::Min(least_frames, hn::IfThenElse(dead, lmd_frames, infinite));
    least_frames = hn::Min(least_frames, hn::IfThenElse(touch_dead, touch_frames, infinite));
    const auto allowed = [&](auto slack, auto for_frames) HWY_ATTR {
      return hn::Add(hn::Add(hn::Mul(slack, share), base), hn::Mul(drift, for_frames));
    };
    least_budget = hn::Min(least_budget, hn::IfThenElse(dead, allowed(lmd_slack, lmd_frames), infinite));
    least_budget =
        hn::Min(least_budget, hn::IfThenElse(touch_dead, allowed(touching.slack, touch_frames), infinite));
  }
  result.frames = hn::GetLane(hn::MinOfLanes(f, least_frames));
  result.deviation_budget = hn::GetLane(hn::MinOfLanes(f, least_budget));
  return result;
}

void lifetime_on_target(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                        const WideForecast& forecast, const WideLifetimeTest& test, WideLifetimes& result) {
  result = test_lifetime(node, probe, limits, forecast, test);
}

/// Nothing here depends on an earlier test, so that a processor works on several at once.
void batch_on_target(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                     const WideForecast& forecast, const WideKeptPair* pairs,
                     std::span<const std::uint32_t> due, WideKeptTest* tests) {
  for (std::size_t i = 0; i < due.size(); ++i) {
    if (i + 2 * FETCH_DISTANCE < due.size()) __builtin_prefetch(&pairs[due[i + 2 * FETCH_DISTANCE]]);
    if (i + FETCH_DISTANCE < due.size()) {
      const WideKeptPair& next = pairs[due[i + FETCH_DISTANCE]];
      fetch((next.open_a ? a : b).nodes[next.node]);
    }
    const WideKeptPair& pair = pairs[due[i]];
    const bool open_a = pair.open_a;
    const WideNode& node = (open_a ? a : b).nodes[pair.node];
    const WideProbe probe = make_probe_vector(pair.child, open_a ? query.b_in_a : query.a_in_b);
    const KindBits kinds = kind_bits(node);
    // What can only touch matters for faces alone.
    const bool may_touch = !pair.child.ref.is_feature() || pair.child.ref.is_face();
    WideLifetimeTest lifetime;
    lifetime.moving_lanes = open_a;
    lifetime.touch_lanes = may_touch ? kinds.faces | (0xFFu & ~kinds.features) : 0u;
    const WideTransform& X = forecast.in_fixed;
    for (int k = 0; k < 3; ++k) {
      lifetime.probe_velocity[k] = open_a ? 0.0F
                                          : X.columns[0][k] * pair.child.centre[0] +
                                                X.columns[1][k] * pair.child.centre[1] +
                                                X.columns[2][k] * pair.child.centre[2] + X.translation[k];
    }
    const WideLifetimes result = test_lifetime(node, probe, query.limits, forecast, lifetime);
    const std::uint32_t final_lanes = pair.child.ref.is_feature() ? kinds.features : 0u;
    tests[i] = {due[i],
                pair.slot_a,
                pair.slot_b,
                result.used,
                (result.lmd | result.touch) & ~final_lanes,
                result.lmd & final_lanes,
                result.touch & final_lanes,
                result.frames,
                result.deviation_budget};
  }
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(lifetime_on_target);
HWY_EXPORT(batch_on_target);

WideForecast::WideForecast(const MotionForecast& motion, const RigidTransform& X_FM, double cutoff_of_arms)
    : in_fixed(motion.turn(), motion.origin_velocity()),
      in_moving(X_FM.rotation.transpose() * motion.turn(),
                X_FM.rotation.transpose() * motion.origin_velocity()),
      creep(round_up_to_single(motion.creep())),
      spin(round_up_to_single(motion.spin())),
      cutoff(round_up_to_single(cutoff_of_arms)),
      base(round_up_to_single(motion.base())),
      drift(round_up_to_single(motion.drift())),
      reach(round_up_to_single(motion.reach())),
      horizon(static_cast<float>(motion.horizon())) {}

WideKeptPair::WideKeptPair(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_of_a,
                           std::uint32_t slot_of_b)
    : slot_a(slot_of_a), slot_b(slot_of_b) {
  const WideOpening opening = choose_opening(a, b, slot_a, slot_b);
  open_a = opening.open_a;
  node = opening.node;
  const std::uint32_t slot = open_a ? slot_b : slot_a;
  child = WideChild((open_a ? b : a).nodes[slot / WIDE_WIDTH], slot % WIDE_WIDTH);
}

void test_batch(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                const WideForecast& forecast, std::span<const WideKeptPair> pairs,
                std::span<const std::uint32_t> due, std::vector<WideKeptTest>& tests) {
  tests.resize(due.size());
  HWY_DYNAMIC_DISPATCH(batch_on_target)(a, b, query, forecast, pairs.data(), due, tests.data());
}

WideLifetimes test_lanes_lifetime(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                  const WideForecast& forecast, const WideLifetimeTest& test) {
  WideLifetimes result;
  HWY_DYNAMIC_DISPATCH(lifetime_on_target)(node, probe, limits, forecast, test, result);
  return result;
}

}  // namespace lmdbench

#endif  // HWY_ONCE
