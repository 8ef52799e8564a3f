// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/hierarchy/single_precision.h>
#include <lmdbench/methods/certified/hierarchy/wide_lanes.h>
#include <lmdbench/methods/certified/hierarchy/wide_traversal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/hierarchy/wide_traversal.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/hierarchy/wide_vectors-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Pairs of the queue that are looked at before their turn, to fetch what they will open: a power of two.
constexpr std::size_t LOOK_AHEAD = 8;
/// Entries of a queue that has never been used; it grows by doubling.
constexpr std::size_t QUEUE_START = 4096;

/// The test of wide_node_test.h.
/// @param widths  WideWidthTest or NoWidths
template <class Lanes, class Widths>
HWY_INLINE WideMasks test_lanes(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                const Widths& widths) {
  using Number = typename Lanes::Number;
  const auto squared = [](Number x) HWY_ATTR { return x * x; };
  const Number zero = Lanes::set(0.0F);
  const Number cutoff = Lanes::set(limits.cutoff);
  const Number touch_limit = Lanes::set(limits.touch);
  WideMasks masks;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count()) {
    const LaneBounds<Lanes> bounds(node, first, probe, limits.rounding);
    auto touch = both_of(both_of(bounds.squared_distance <= squared(touch_limit + bounds.radii),
                                 magnitude(bounds.z_probe) <= touch_limit + bounds.slab_probe),
                         magnitude(bounds.z_lane) <= touch_limit + bounds.slab_lane);
    const auto near = both_of(both_of(bounds.squared_distance <= squared(cutoff + bounds.radii),
                                      bounds.z_probe <= cutoff + bounds.slab_probe),
                              bounds.z_lane <= cutoff + bounds.slab_lane);

    const auto collinear =
        -bounds.between >= (bounds.cosine * bounds.probe_cosine - bounds.sine * bounds.probe_sine) -
                               Lanes::set(DIRECTION_ROUNDING);

    const Number least_squared_distance = bounds.squared_distance * Lanes::set(1.0F - DIRECTION_ROUNDING);
    const auto inside = [&](Number z, Number reach, Number cosine, Number sine) HWY_ATTR {
      const Number side = bounds.radii * cosine + sine * least_of(reach, cutoff * cosine);
      return both_of(reach >= zero, (least_squared_distance - squared(z)) * squared(cosine) <= squared(side));
    };
    auto directed = both_of(
        inside(bounds.z_probe, bounds.z_probe + bounds.slab_probe, bounds.probe_cosine, bounds.probe_sine),
        inside(bounds.z_lane, bounds.z_lane + bounds.slab_lane, bounds.cosine, bounds.sine));

    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      const LaneWidths<Lanes> across(bounds, node, first, probe, widths, limits.rounding);
      touch = both_of(touch, both_of(across.gap_probe <= touch_limit, across.gap_lane <= touch_limit));
      directed = both_of(directed, both_of(across.gap_probe <= bounds.probe_sine * cutoff,
                                           across.gap_lane <= bounds.sine * cutoff));
    }

    const std::uint32_t used_bits = Lanes::bits(Lanes::not_zero(node.child, first), first);
    const std::uint32_t touch_bits = Lanes::bits(touch, first) & used_bits;
    const std::uint32_t near_bits = Lanes::bits(near, first) & used_bits;
    const std::uint32_t collinear_bits = Lanes::bits(collinear, first);
    const std::uint32_t directed_bits = Lanes::bits(directed, first);
    masks.used |= used_bits;
    masks.touch |= touch_bits;
    masks.lmd |= near_bits & collinear_bits & directed_bits;
    masks.beyond |= used_bits & ~touch_bits & ~near_bits;
    masks.not_collinear |= near_bits & ~touch_bits & ~collinear_bits;
  }
  return masks;
}

struct VectorTest {
  template <class Widths>
  HWY_INLINE WideMasks operator()(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                                  const Widths& widths) const {
    return test_lanes<VectorLanes>(node, probe, limits, widths);
  }
};

struct ScalarTest {
  WideMasks operator()(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                       const NoWidths&) const {
    return test_lanes_scalar(node, probe, limits);
  }
  WideMasks operator()(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                       const WideWidthTest& widths) const {
    return test_lanes_scalar(node, probe, limits, &widths);
  }
};

/// First in, first out, without a data-dependent branch but for found pairs: a processor then works on
/// several tests at once, because none waits for what the one before it appends.
/// @tparam Widths  WideWidthTest where one of the meshes has long features, else NoWidths
template <class Test, class Widths>
void descend(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, WideScratch& scratch,
             WideCounters& counters) {
  const Test test{};
  const WideNode* const nodes_a = a.nodes.data();
  const WideNode* const nodes_b = b.nodes.data();
  WideCounters count;
  const hn::RebindToUnsigned<FloatTag> u;
  if (scratch.queue_a.size() < QUEUE_START) scratch.resize_queue(QUEUE_START);
  scratch.queue_a[0] = scratch.queue_b[0] = 0;
  std::size_t end = 1, looked_at = 0;
  std::array<WideOpening, LOOK_AHEAD> openings;
  for (std::size_t next = 0; next < end; ++next) {
    if (end + WIDE_WIDTH > scratch.queue_a.size()) scratch.resize_queue(2 * scratch.queue_a.size());
    std::uint32_t* const queue_a = scratch.queue_a.data();
    std::uint32_t* const queue_b = scratch.queue_b.data();
    const std::uint32_t slot_a = queue_a[next], slot_b = queue_b[next];
    const WideNode& home_a = nodes_a[slot_a / WIDE_WIDTH];
    const WideNode& home_b = nodes_b[slot_b / WIDE_WIDTH];
    const std::uint32_t lane_a = slot_a % WIDE_WIDTH, lane_b = slot_b % WIDE_WIDTH;
    const WideRef ref_a = WideRef::from_bits(home_a.child[lane_a]);
    const WideRef ref_b = WideRef::from_bits(home_b.child[lane_b]);
    for (; looked_at < std::min(end, next + LOOK_AHEAD); ++looked_at) {
      const WideOpening ahead = choose_opening(a, b, queue_a[looked_at], queue_b[looked_at]);
      fetch((ahead.open_a ? nodes_a : nodes_b)[ahead.node]);
      openings[looked_at % LOOK_AHEAD] = ahead;
    }
    const WideOpening opening = openings[next % LOOK_AHEAD];
    const bool open_a = opening.open_a;
    const WideTransform& X = open_a ? query.b_in_a : query.a_in_b;
    const WideProbe probe = make_probe(open_a ? WideChild(home_b, lane_b) : WideChild(home_a, lane_a), X);
    const WideRef probe_ref = open_a ? ref_b : ref_a;
    const WideNode& node = (open_a ? nodes_a : nodes_b)[opening.node];
    const std::uint32_t probe_slot = open_a ? slot_b : slot_a;

    WideMasks masks;
    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      masks = test(node, probe, query.limits,
                   make_width_test(open_a ? a : b, opening.node, open_a ? b : a, probe_slot, X));
    } else {
      masks = test(node, probe, query.limits, NoWidths());
    }
    ++count.node_tests;
    count.node_pairs += static_cast<std::uint64_t>(std::popcount(masks.used));
    count.rejected_g1 += static_cast<std::uint64_t>(std::popcount(masks.beyond));
    count.rejected_g2 += static_cast<std::uint64_t>(std::popcount(masks.not_collinear));
    count.rejected_g3 += static_cast<std::uint64_t>(
        std::popcount(masks.used & ~masks.lmd & ~masks.touch & ~masks.beyond & ~masks.not_collinear));

    // What can only touch matters for faces alone.
    const KindBits kinds = kind_bits(node);
    const bool may_touch = !probe_ref.is_feature() || probe_ref.is_face();
    const std::uint32_t touch = may_touch ? masks.touch & (kinds.faces | ~kinds.features) : 0u;
    const std::uint32_t alive = masks.lmd | touch;
    const std::uint32_t final_pairs = probe_ref.is_feature() ? kinds.features : 0u;
    const LaneList& lanes = LANE_LISTS[alive & ~final_pairs];
    // Eight entries are written, as many as survive are kept.
    std::uint32_t* const of_opened = (open_a ? queue_a : queue_b) + end;
    std::uint32_t* const of_probe = (open_a ? queue_b : queue_a) + end;
    for (std::size_t first = 0; first < WIDE_WIDTH; first += hn::Lanes(u)) {
      const auto list =
          hn::PromoteTo(u, hn::LoadU(hn::Rebind<std::uint8_t, decltype(u)>(), lanes.lane.data() + first));
      hn::StoreU(hn::Add(list, hn::Set(u, opening.node * WIDE_WIDTH)), u, of_opened + first);
      hn::StoreU(hn::Set(u, probe_slot), u, of_probe + first);
    }
    end += lanes.count;

    for (std::uint32_t left = alive & final_pairs; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
      const WideRef child = WideRef::from_bits(node.child[lane]);
      const WidePair pair = open_a ? WidePair{child, probe_ref} : WidePair{probe_ref, child};
      if ((masks.lmd >> lane & 1u) != 0) scratch.lmd_pairs.push_back(pair);
      if ((touch >> lane & 1u) != 0) scratch.touch_pairs.push_back(pair);
    }
  }
  counters = count;
}

template <class Test>
void descend_by(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, WideScratch& scratch,
                WideCounters& counters) {
  if (a.widths.empty() && b.widths.empty())
    descend<Test, NoWidths>(a, b, query, scratch, counters);
  else
    descend<Test, WideWidthTest>(a, b, query, scratch, counters);
}

void descend_vector(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                    WideScratch& scratch, WideCounters& counters) {
  descend_by<VectorTest>(a, b, query, scratch, counters);
}

void descend_scalar(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                    WideScratch& scratch, WideCounters& counters) {
  descend_by<ScalarTest>(a, b, query, scratch, counters);
}

void test_vector(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                 const WideWidthTest* widths, WideMasks& masks) {
  masks = widths == nullptr ? VectorTest{}(node, probe, limits, NoWidths())
                            : VectorTest{}(node, probe, limits, *widths);
}

const char* traversal_target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(descend_vector);
HWY_EXPORT(descend_scalar);
HWY_EXPORT(test_vector);
HWY_EXPORT(traversal_target_name);

WideQuery::WideQuery(const WideHierarchy& a, const WideHierarchy& b, const RigidTransform& X_BA,
                     double cutoff, double touch) {
  const Vec3 p_BA = X_BA.point(a.origin) - b.origin;  // a's origin in b's hierarchy frame
  const double between = p_BA.norm();
  const double size = between + a.radius + b.radius;
  possible = !a.nodes.empty() && !b.nodes.empty() &&
             between <= (a.radius + b.radius + std::max(cutoff, touch)) * (1.0 + POSITION_ROUNDING);
  if (!possible) return;
  a_in_b = WideTransform(X_BA.rotation, p_BA);
  b_in_a = WideTransform(X_BA.rotation.transpose(), -(X_BA.rotation.transpose() * p_BA));
  // The rounding of the two origins in the mesh frames is that of double precision, but
  // grows with their coordinates.
  const double far_away = 1e-15 * (X_BA.translation.norm() + a.origin.norm() + b.origin.norm());
  limits.cutoff = round_up_to_single(std::min(cutoff, 2.0 * size));
  limits.touch = round_up_to_single(touch);
  limits.rounding = round_up_to_single(POSITION_ROUNDING * size + far_away);
}

void find_wide_pairs(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                     WideKernel kernel, WideScratch& scratch, WideCounters& counters) {
  scratch.lmd_pairs.clear();
  scratch.touch_pairs.clear();
  if (!query.possible) return;
  if (kernel == WideKernel::VECTOR) {
    HWY_DYNAMIC_DISPATCH(descend_vector)(a, b, query, scratch, counters);
  } else {
    HWY_DYNAMIC_DISPATCH(descend_scalar)(a, b, query, scratch, counters);
  }
}

WideMasks test_lanes_scalar(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                            const WideWidthTest* widths) {
  using HWY_NAMESPACE::ScalarLanes;
  return widths == nullptr ? HWY_NAMESPACE::test_lanes<ScalarLanes>(node, probe, limits, NoWidths())
                           : HWY_NAMESPACE::test_lanes<ScalarLanes>(node, probe, limits, *widths);
}

WideMasks test_lanes_vector(const WideNode& node, const WideProbe& probe, const WideLimits& limits,
                            const WideWidthTest* widths) {
  WideMasks masks;
  HWY_DYNAMIC_DISPATCH(test_vector)(node, probe, limits, widths, masks);
  return masks;
}

std::string_view wide_kernel_target() {
  return HWY_DYNAMIC_DISPATCH(traversal_target_name)();
}

}  // namespace lmdbench

#endif  // HWY_ONCE
