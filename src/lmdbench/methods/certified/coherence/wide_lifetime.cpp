// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/coherence/wide_lifetime.h>
#include <lmdbench/methods/certified/hierarchy/single_precision.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

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

/// A criterion that rejects lanes: how far it is from failing and what it loses in a frame.
template <class Number>
struct Criterion {
  Number slack, loss, value;
};

template <class Lanes, class Number = typename Lanes::Number>
HWY_INLINE Criterion<Number> make_criterion(Number slack, Number loss) {
  // What does not reject now is the last choice, however little it loses.
  return {slack, loss,
          select(slack > Lanes::set(0.0F), slack - loss * Lanes::set(CHOICE_FRAMES),
                 slack - Lanes::set(NO_CHOICE))};
}

/// The one of two that will reject for longer, roughly.
template <class Number>
HWY_INLINE Criterion<Number> better(const Criterion<Number>& a, const Criterion<Number>& b) {
  const auto second = b.value > a.value;
  return {select(second, b.slack, a.slack), select(second, b.loss, a.loss), largest_of(a.value, b.value)};
}

/// The test of wide_lifetime.h.
/// @param widths  WideWidthTest or NoWidths
template <class Lanes, class Widths>
HWY_INLINE WideLifetimes test_lifetime(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                       const WideForecast& forecast, const WideLifetimeTest& test,
                                       const Widths& widths) {
  using Number = typename Lanes::Number;
  using Bounds = LaneBounds<Lanes>;
  const auto set = [](float x) HWY_ATTR { return Lanes::set(x); };
  const auto criterion = [](Number slack, Number loss)
                             HWY_ATTR { return make_criterion<Lanes>(slack, loss); };
  const Number zero = set(0.0F), least = set(LEAST_LENGTH), cutoff = set(limits.cutoff);
  const Number base = set(forecast.base), drift = set(forecast.drift), reach = set(forecast.reach);
  const Number horizon = set(forecast.horizon), half_diagonal = set(HALF_DIAGONAL);
  const Number rest = set(1.0F - DEVIATION_SHARE), least_share = set(LEAST_SHARE);
  const Number longest_plan = set(static_cast<float>(MotionForecast::LONGEST_PLAN));
  const Number infinite = set(std::numeric_limits<float>::infinity());
  const Number angle_loss = largest_of(set(forecast.spin * forecast.reach), least);
  const WideTransform& X = forecast.in_moving;
  Number least_frames = infinite, least_budget = infinite;

  const WidePlaces places(node, widths);
  WideLifetimes result;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count()) {
    const Bounds bounds(node, places, first, probe, limits.rounding);
    // Motion of the lane's centre against the probe's in a frame, and what nothing is known of but its size.
    Number ex = set(-test.probe_velocity[0]);
    Number ey = set(-test.probe_velocity[1]);
    Number ez = set(-test.probe_velocity[2]);
    Number lever_arm = set(probe.radius + 2.0F * forecast.cutoff), from_origin = set(test.probe_distance);
    if (test.moving_lanes) {
      const auto row = [&](int i) HWY_ATTR {
        return ((set(X.columns[0][i]) * bounds.cx + set(X.columns[1][i]) * bounds.cy) +
                set(X.columns[2][i]) * bounds.cz) +
               set(X.translation[i]);
      };
      ex = row(0);
      ey = row(1);
      ez = row(2);
      lever_arm = bounds.radius + set(2.0F * forecast.cutoff);
      from_origin = root(Bounds::dot(bounds.cx, bounds.cy, bounds.cz, bounds.cx, bounds.cy, bounds.cz));
    }
    const Number extra = set(forecast.spin) * lever_arm + set(forecast.creep);

    const Number z_probe = bounds.z_probe, z_lane = bounds.z_lane;
    const Number growth = Bounds::dot(bounds.dx, bounds.dy, bounds.dz, ex, ey, ez);
    const Number rise_probe = Bounds::dot(ex, ey, ez, bounds.axis_x, bounds.axis_y, bounds.axis_z);
    const Number rise_lane = -Bounds::dot(ex, ey, ez, bounds.ux, bounds.uy, bounds.uz);
    const Number least_squared_distance = bounds.squared_distance * set(1.0F - DIRECTION_ROUNDING);
    const Number distance = root(least_squared_distance);
    const Number reach_probe = z_probe + bounds.slab_probe, reach_lane = z_lane + bounds.slab_lane;

    const auto lost = [&](Number loss) HWY_ATTR { return largest_of(loss + extra, least); };
    const auto apart = criterion(distance - bounds.radii, lost(-(growth / largest_of(distance, least))));
    const auto above_probe = criterion(z_probe - bounds.slab_probe, lost(-rise_probe));
    const auto above_lane = criterion(z_lane - bounds.slab_lane, lost(-rise_lane));
    const auto below_probe = criterion(-reach_probe, lost(rise_probe));
    const auto below_lane = criterion(-reach_lane, lost(rise_lane));

    const auto beside = [&](Number z, Number rise, Number reached, Number cosine, Number sine) HWY_ATTR {
      const Number lateral = root(largest_of(least_squared_distance - z * z, zero));
      const Number lateral_growth = (growth - z * rise) / largest_of(lateral, least);
      const Number limit = cutoff * cosine;
      const Number side = bounds.radii * cosine + sine * least_of(reached, limit);
      const Number side_growth = select(reached < limit, sine * rise, zero);
      return criterion((lateral * cosine - side) * half_diagonal,
                       lost((side_growth - lateral_growth * cosine) * half_diagonal));
    };
    auto length = better(beside(z_probe, rise_probe, reach_probe, bounds.probe_cosine, bounds.probe_sine),
                         beside(z_lane, rise_lane, reach_lane, bounds.cosine, bounds.sine));
    length = better(length, better(below_probe, below_lane));
    const auto past = [&](const Criterion<Number>& of, Number limit)
                          HWY_ATTR { return criterion(of.slack - limit, of.loss); };
    const auto farther_than = [&](Number limit) HWY_ATTR {
      return better(better(past(apart, limit), past(above_probe, limit)), past(above_lane, limit));
    };
    length = better(length, farther_than(cutoff));
    const Number touch_limit = set(limits.touch);
    auto touching = better(farther_than(touch_limit),
                           better(past(below_probe, touch_limit), past(below_lane, touch_limit)));
    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      const LaneWidths<Lanes> across(bounds, node, places, first, probe, widths, limits.rounding);
      const auto beyond = [&](Number gap, Number along, Number rise)
                              HWY_ATTR { return criterion(gap, lost(select(along < zero, rise, -rise))); };
      const auto across_probe =
          beyond(across.gap_probe, across.along_probe,
                 Bounds::dot(ex, ey, ez, across.across_x, across.across_y, across.across_z));
      const auto across_lane = beyond(across.gap_lane, across.along_lane,
                                      Bounds::dot(ex, ey, ez, across.bx, across.by, across.bz));
      length = better(length, better(past(across_probe, bounds.probe_sine * cutoff),
                                     past(across_lane, bounds.sine * cutoff)));
      touching = better(touching, better(past(across_probe, touch_limit), past(across_lane, touch_limit)));
    }

    const Number g2_cosines =
        ((bounds.cosine * bounds.probe_cosine - bounds.sine * bounds.probe_sine) - set(DIRECTION_ROUNDING)) +
        bounds.between;
    const Number angle_slack =
        (g2_cosines / select(bounds.between <= zero, bounds.across, set(1.0F))) * reach;

    // The share of the slack, the base and the drift are left when the loss has used up the rest.
    const auto frames = [&](Number slack, Number loss)
                            HWY_ATTR { return (slack * rest - base) / (loss + drift); };
    const auto planned = [&](Number slack, Number loss, Number wanted) HWY_ATTR {
      return least_of(largest_of(wanted, slack * least_share / loss), longest_plan);
    };
    const Number length_frames = frames(length.slack, length.loss);
    const Number angle_frames = frames(angle_slack, angle_loss);
    const Number touch_frames = frames(touching.slack, touching.loss);
    const auto by_length = length_frames >= angle_frames;
    const Number lmd_slack = select(by_length, length.slack, angle_slack);
    const Number lmd_loss = select(by_length, length.loss, angle_loss);
    const Number lmd_plan = planned(lmd_slack, lmd_loss, largest_of(length_frames, angle_frames));
    const Number touch_plan = planned(touching.slack, touching.loss, touch_frames);

    const auto used = Lanes::not_zero(node.child, first);
    const auto touch_matters = both_of(used, Lanes::of_bits(test.touch_lanes, first));
    const auto soon = [&](Number slack, Number loss) HWY_ATTR { return slack <= loss * horizon; };
    const auto lmd = both_of(used, both_of(soon(length.slack, length.loss), soon(angle_slack, angle_loss)));
    const auto touch = both_of(touch_matters, soon(touching.slack, touching.loss));
    result.used |= Lanes::bits(used, first);
    result.lmd |= Lanes::bits(lmd, first);
    result.touch |= Lanes::bits(touch, first);
    const auto dead = but_not(used, lmd), touch_dead = but_not(touch_matters, touch);
    // Lemma 17: as much as a deviation counts for, or more where the lane reaches farther.
    const Number weight = largest_of((from_origin + lever_arm) / reach, set(1.0F));
    const auto left = [&](Number slack, Number loss, Number for_frames)
                          HWY_ATTR { return (slack - loss * for_frames) / weight; };
    least_frames = least_of(least_frames, select(dead, lmd_plan, infinite));
    least_frames = least_of(least_frames, select(touch_dead, touch_plan, infinite));
    least_budget = least_of(least_budget, select(dead, left(lmd_slack, lmd_loss, lmd_plan), infinite));
    least_budget =
        least_of(least_budget, select(touch_dead, left(touching.slack, touching.loss, touch_plan), infinite));
  }
  result.frames = Lanes::least(least_frames);
  result.deviation_budget = Lanes::least(least_budget);
  return result;
}

template <class Lanes>
WideLifetimes lifetime_of(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                          const WideForecast& forecast, const WideLifetimeTest& test,
                          const WideWidthTest* widths) {
  return widths == nullptr ? test_lifetime<Lanes>(node, probe, limits, forecast, test, NoWidths())
                           : test_lifetime<Lanes>(node, probe, limits, forecast, test, *widths);
}

void lifetime_on_target(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                        const WideForecast& forecast, const WideLifetimeTest& test,
                        const WideWidthTest* widths, WideLifetimes& result) {
  result = lifetime_of<VectorLanes>(node, probe, limits, forecast, test, widths);
}

/// Nothing here depends on an earlier test, so that a processor works on several at once.
/// @tparam Widths  WideWidthTest where one of the meshes has long features, else NoWidths
template <class Widths>
void make_batch(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                const WideForecast& forecast, const SteadyArray<WideKeptPair>& pairs,
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
    const WideTransform& child_in_open = open_a ? query.b_in_a : query.a_in_b;
    const WideProbe probe = make_probe(pair.child, child_in_open);
    const KindBits kinds = kind_bits(node);
    // What can only touch matters for faces alone.
    const bool may_touch = !pair.child.ref.is_feature() || pair.child.ref.is_face();
    WideLifetimeTest lifetime;
    lifetime.moving_lanes = open_a;
    lifetime.touch_lanes = may_touch ? kinds.faces | (0xFFu & ~kinds.features) : 0u;
    const float* const centre = pair.child.centre;
    lifetime.probe_distance =
        std::sqrt(centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]);
    const WideTransform& X = forecast.in_fixed;
    for (int k = 0; k < 3; ++k) {
      lifetime.probe_velocity[k] = open_a ? 0.0F
                                          : X.columns[0][k] * centre[0] + X.columns[1][k] * centre[1] +
                                                X.columns[2][k] * centre[2] + X.translation[k];
    }
    WideLifetimes result;
    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      const std::uint32_t slot = open_a ? pair.slot_b : pair.slot_a;
      result = test_lifetime<VectorLanes>(
          node, probe, query.limits, forecast, lifetime,
          make_width_test(open_a ? a : b, pair.node, open_a ? b : a, slot, child_in_open));
    } else {
      result = test_lifetime<VectorLanes>(node, probe, query.limits, forecast, lifetime, NoWidths());
    }
    const std::uint32_t final_lanes = pair.child.ref.is_feature() ? kinds.features : 0u;
    tests[i] = {due[i],
                result.used,
                (result.lmd | result.touch) & ~final_lanes,
                result.lmd & final_lanes,
                result.touch & final_lanes,
                result.frames,
                result.deviation_budget};
  }
}

void batch_on_target(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                     const WideForecast& forecast, const SteadyArray<WideKeptPair>& pairs,
                     std::span<const std::uint32_t> due, WideKeptTest* tests) {
  if (a.widths.empty() && b.widths.empty())
    make_batch<NoWidths>(a, b, query, forecast, pairs, due, tests);
  else
    make_batch<WideWidthTest>(a, b, query, forecast, pairs, due, tests);
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
                const WideForecast& forecast, const SteadyArray<WideKeptPair>& pairs,
                std::span<const std::uint32_t> due, std::vector<WideKeptTest>& tests) {
  tests.resize(due.size());
  HWY_DYNAMIC_DISPATCH(batch_on_target)(a, b, query, forecast, pairs, due, tests.data());
}

WideLifetimes test_lanes_lifetime(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                  const WideForecast& forecast, const WideLifetimeTest& test,
                                  const WideWidthTest* widths) {
  WideLifetimes result;
  HWY_DYNAMIC_DISPATCH(lifetime_on_target)(node, probe, limits, forecast, test, widths, result);
  return result;
}

WideLifetimes test_lanes_lifetime_scalar(const WideNode& node, const WideProbe& probe,
                                         const WideLimits& limits, const WideForecast& forecast,
                                         const WideLifetimeTest& test, const WideWidthTest* widths) {
  return HWY_NAMESPACE::lifetime_of<HWY_NAMESPACE::ScalarLanes>(node, probe, limits, forecast, test, widths);
}

}  // namespace lmdbench

#endif  // HWY_ONCE
