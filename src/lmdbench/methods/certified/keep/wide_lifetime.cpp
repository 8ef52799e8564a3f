// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/keep/wide_lifetime.h>
#include <lmdbench/methods/certified/layout/single_precision.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/keep/wide_lifetime.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/traverse/wide_criteria-inl.h>

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

/// How the difference D of the centres changes in a frame.
template <class Lanes>
struct LaneMotion {
  using Number = typename Lanes::Number;
  Number growth;                   ///< Of |D|^2 / 2 [m^2].
  Number speed;                    ///< Of D [m].
  Number growth_error;             ///< Of what `growth` leaves across an axis, by rounding [m^2].
  Number rise_probe, rise_lane;    ///< Of z [m].
  Number widen_probe, widen_lane;  ///< Of D . b [m]; with widths alone.
  Number extra;                    ///< Change of known size only [m].
};

/// Of the criteria asked, the one that will reject for about the longest.
template <class Lanes>
struct Lasting {
  using Number = typename Lanes::Number;
  const LaneMotion<Lanes>& motion;
  bool is_first = true;
  Criterion<Number> best{};

  HWY_INLINE void apart(Number squared_distance, Number radii, Number limit) {
    const Number distance = root(squared_distance * Lanes::set(1.0F - DIRECTION_ROUNDING));
    ask((distance - radii) - limit, -(motion.growth / largest_of(distance, Lanes::set(LEAST_LENGTH))));
  }
  HWY_INLINE void above(Number z, Number slab, Number limit, Of of) { ask((z - slab) - limit, -rise(of)); }
  HWY_INLINE void outside(Number z, Number slab, Number limit, Of of) {
    // Of the two sides the one where z is.
    ask((magnitude(z) - slab) - limit, select(z < Lanes::set(0.0F), rise(of), -rise(of)));
  }
  HWY_INLINE void behind(Number z, Number slab, Of of) { ask(-(z + slab), rise(of)); }
  HWY_INLINE void beside(const typename NodeCriteria<Lanes>::Beside& x, Of of) {
    const Number zero = Lanes::set(0.0F), half_diagonal = Lanes::set(HALF_DIAGONAL);
    const Number lateral = root(largest_of(x.squared_lateral, zero));
    // Next to the axis products cancel: of the growth a lower bound counts, of what grows over an
    // upper bound of the length, of what shrinks over a lower one. Nothing shrinks faster than d.
    const Number growing = (motion.growth - x.z * rise(of)) - motion.growth_error;
    const auto grows = growing > zero;
    const Number length = select(
        grows, x.squared_lateral + x.squared_distance * Lanes::set(2.0F * DIRECTION_ROUNDING), lateral);
    const Number lateral_growth =
        largest_of(select(grows, growing * lateral, growing) / largest_of(length, Lanes::set(LEAST_LENGTH)),
                   -motion.speed);
    const Number side_growth = select(x.reached < x.limit, x.sine * rise(of), zero);
    ask((lateral * x.cosine - x.side) * half_diagonal,
        (side_growth - lateral_growth * x.cosine) * half_diagonal);
  }
  HWY_INLINE void across(Number gap, Number limit, Number along, Of of) {
    const Number widening = of == Of::PROBE ? motion.widen_probe : motion.widen_lane;
    ask(gap - limit, select(along < Lanes::set(0.0F), widening, -widening));
  }

 private:
  HWY_INLINE Number rise(Of of) const { return of == Of::PROBE ? motion.rise_probe : motion.rise_lane; }
  /// @param loss  of the slack in a frame, by the motion of the centres
  HWY_INLINE void ask(Number slack, Number loss) {
    const auto asked =
        make_criterion<Lanes>(slack, largest_of(loss + motion.extra, Lanes::set(LEAST_LENGTH)));
    best = is_first ? asked : better(best, asked);
    is_first = false;
  }
  static HWY_INLINE Criterion<Number> better(const Criterion<Number>& a, const Criterion<Number>& b) {
    const auto second = b.value > a.value;
    return {select(second, b.slack, a.slack), select(second, b.loss, a.loss), largest_of(a.value, b.value)};
  }
};

/// Where touching does not matter.
struct NotAsked {
  explicit HWY_INLINE NotAsked(const auto&) {}
  static HWY_INLINE void apart(const auto&...) {}
  static HWY_INLINE void outside(const auto&...) {}
  static HWY_INLINE void across(const auto&...) {}
};

/// Keeps the only value that it is handed: G2, whose slack is an angle.
template <class Number>
struct Turned {
  Number cosines;
  HWY_INLINE void turned(Number value) { cosines = value; }
};

/// The test of wide_lifetime.h.
/// @tparam Touches  whether touching matters for some lane
/// @param widths  WideWidthTest or NoWidths
template <class Lanes, bool Touches, class Widths>
HWY_INLINE WideLifetimes lifetimes_of(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                      const WideForecast& forecast, const WideLifetimeTest& test,
                                      const Widths& widths) {
  using Number = typename Lanes::Number;
  using Bounds = LaneBounds<Lanes>;
  const auto set = [](float x) HWY_ATTR { return Lanes::set(x); };
  const Number zero = set(0.0F), least = set(LEAST_LENGTH);
  const Number base = set(forecast.base), drift = set(forecast.drift), extent = set(forecast.extent);
  const Number horizon = set(forecast.horizon);
  const Number rest = set(1.0F - DEVIATION_SHARE), least_share = set(LEAST_SHARE);
  const Number longest_plan = set(static_cast<float>(MotionForecast::LONGEST_PLAN));
  const Number infinite = set(std::numeric_limits<float>::infinity());
  const Number angle_loss = largest_of(set(forecast.spin * forecast.extent), least);
  const WideTransform& X = forecast.in_moving;
  Number least_frames = infinite, least_budget = infinite;

  const WidePlaces places(node, widths);
  WideLifetimes result;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count()) {
    const Bounds bounds(node, places, first, probe, limits.rounding);
    // Motion of the lane's centre against the probe's in a frame.
    Number ex = set(-test.probe_velocity[0]);
    Number ey = set(-test.probe_velocity[1]);
    Number ez = set(-test.probe_velocity[2]);
    Number lever_arm = set(probe.radius + 2.0F * forecast.search_distance),
           from_origin = set(test.probe_distance);
    if (test.moving_lanes) {
      const auto row = [&](int i) HWY_ATTR {
        return ((set(X.columns[0][i]) * bounds.cx + set(X.columns[1][i]) * bounds.cy) +
                set(X.columns[2][i]) * bounds.cz) +
               set(X.translation[i]);
      };
      ex = row(0);
      ey = row(1);
      ez = row(2);
      lever_arm = bounds.radius + set(2.0F * forecast.search_distance);
      from_origin = root(Bounds::dot(bounds.cx, bounds.cy, bounds.cz, bounds.cx, bounds.cy, bounds.cz));
    }
    const Number speed = root(Bounds::dot(ex, ey, ez, ex, ey, ez));
    LaneMotion<Lanes> motion{Bounds::dot(bounds.dx, bounds.dy, bounds.dz, ex, ey, ez),
                             speed,
                             root(bounds.squared_distance) * speed * set(GROWTH_ROUNDING),
                             Bounds::dot(ex, ey, ez, bounds.axis_x, bounds.axis_y, bounds.axis_z),
                             -Bounds::dot(ex, ey, ez, bounds.ux, bounds.uy, bounds.uz),
                             zero,
                             zero,
                             set(forecast.spin) * lever_arm + set(forecast.creep)};
    const NodeCriteria<Lanes> criteria(bounds, limits);
    Lasting<Lanes> lmd_lasts{motion};
    std::conditional_t<Touches, Lasting<Lanes>, NotAsked> touch_lasts{motion};
    Turned<Number> normals;
    criteria.directed(lmd_lasts);
    criteria.near(lmd_lasts);
    criteria.near_touch(touch_lasts);
    criteria.collinear(normals);
    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      const LaneWidths<Lanes> across(bounds, node, places, first, probe, widths, limits.rounding);
      motion.widen_probe = Bounds::dot(ex, ey, ez, across.across_x, across.across_y, across.across_z);
      motion.widen_lane = Bounds::dot(ex, ey, ez, across.bx, across.by, across.bz);
      criteria.apart_across(across, lmd_lasts, touch_lasts);
    }
    const Criterion<Number>& length = lmd_lasts.best;
    const Number angle_slack =
        (normals.cosines / select(bounds.between <= zero, bounds.across, set(1.0F))) * extent;

    const auto used = Lanes::not_zero(node.child, first);
    const auto soon = [&](Number slack, Number loss) HWY_ATTR { return slack <= loss * horizon; };
    // Budget over slack: less where the lane extends beyond the forecast's extent (lemma 17).
    const Number share = least_of(extent / (from_origin + lever_arm), set(1.0F));
    // Plans leave DEVIATION_SHARE, base and drift of a slack, but use LEAST_SHARE of it.
    const auto spare = [&](Number slack) HWY_ATTR { return slack * rest - base; };
    const auto plan = [&](auto lanes, Number slack, Number loss) HWY_ATTR {
      const Number wanted = spare(slack) / (loss + drift);
      const Number planned = least_of(largest_of(wanted, slack * least_share / loss), longest_plan);
      least_frames = least_of(least_frames, select(lanes, planned, infinite));
      least_budget = least_of(least_budget, select(lanes, (slack - loss * planned) * share, infinite));
    };

    const auto by_length =
        spare(length.slack) * (angle_loss + drift) >= spare(angle_slack) * (length.loss + drift);
    const auto lmd = both_of(used, both_of(soon(length.slack, length.loss), soon(angle_slack, angle_loss)));
    plan(but_not(used, lmd), select(by_length, length.slack, angle_slack),
         select(by_length, length.loss, angle_loss));
    result.used |= Lanes::bits(used, first);
    result.lmd |= Lanes::bits(lmd, first);
    if constexpr (Touches) {
      const Criterion<Number>& touching = touch_lasts.best;
      const auto matters = both_of(used, Lanes::of_bits(test.touch_lanes, first));
      const auto touch = both_of(matters, soon(touching.slack, touching.loss));
      plan(but_not(matters, touch), touching.slack, touching.loss);
      result.touch |= Lanes::bits(touch, first);
    }
  }
  result.frames = Lanes::least(least_frames);
  result.deviation_budget = Lanes::least(least_budget);
  LMDBENCH_ENSURES(((result.lmd | result.touch) & ~result.used) == 0 && !std::isnan(result.frames) &&
                       !std::isnan(result.deviation_budget),
                   "a criterion that is no number");
  return result;
}

template <class Lanes, class Widths>
HWY_INLINE WideLifetimes test_lifetime(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                       const WideForecast& forecast, const WideLifetimeTest& test,
                                       const Widths& widths) {
  return test.touch_lanes != 0 ? lifetimes_of<Lanes, true>(node, probe, limits, forecast, test, widths)
                               : lifetimes_of<Lanes, false>(node, probe, limits, forecast, test, widths);
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
      fetch((next.open_a ? b : a).nodes[next.other_slot() / WIDE_WIDTH]);
    }
    const WideKeptPair& pair = pairs[due[i]];
    const bool open_a = pair.open_a;
    const WideNode& node = (open_a ? a : b).nodes[pair.node];
    const std::uint32_t slot = pair.other_slot();
    const WideChild child((open_a ? b : a).nodes[slot / WIDE_WIDTH], slot % WIDE_WIDTH);
    const WideTransform& child_in_open = open_a ? query.b_in_a : query.a_in_b;
    const WideProbe probe = make_probe(child, child_in_open);
    const KindBits kinds = kind_bits(node);
    // Touching matters for faces alone.
    const bool may_touch = !child.ref.is_feature() || child.ref.is_face();
    WideLifetimeTest lifetime;
    lifetime.moving_lanes = open_a;
    lifetime.touch_lanes = may_touch ? kinds.faces | (0xFFu & ~kinds.features) : 0u;
    const float* const centre = child.centre;
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
      result = test_lifetime<VectorLanes>(
          node, probe, query.limits, forecast, lifetime,
          make_width_test(open_a ? a : b, pair.node, open_a ? b : a, slot, child_in_open));
    } else {
      result = test_lifetime<VectorLanes>(node, probe, query.limits, forecast, lifetime, NoWidths());
    }
    const std::uint32_t final_lanes = child.ref.is_feature() ? kinds.features : 0u;
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

WideForecast::WideForecast(const MotionForecast& motion, const RigidTransform& X_FM, double of_arms)
    : in_fixed(motion.turn(), motion.origin_velocity()),
      in_moving(X_FM.rotation.transpose() * motion.turn(),
                X_FM.rotation.transpose() * motion.origin_velocity()),
      creep(round_up_to_single(motion.creep())),
      spin(round_up_to_single(motion.spin())),
      search_distance(round_up_to_single(of_arms)),
      base(round_up_to_single(motion.base())),
      drift(round_up_to_single(motion.drift())),
      extent(round_up_to_single(motion.extent())),
      horizon(static_cast<float>(motion.horizon())) {}

WideKeptPair::WideKeptPair(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_of_a,
                           std::uint32_t slot_of_b)
    : slot_a(slot_of_a), slot_b(slot_of_b) {
  const WideOpening opening = choose_opening(a, b, slot_a, slot_b);
  open_a = opening.open_a;
  node = opening.node;
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
