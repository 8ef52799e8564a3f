// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/layout/single_precision.h>
#include <lmdbench/methods/certified/traverse/wide_lanes.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/traverse/wide_traversal.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/traverse/wide_criteria-inl.h>
#include <lmdbench/methods/certified/traverse/wide_moved_nodes-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Pairs that are taken from a stack together, and how many of them before their turn the nodes
/// that they open are fetched: powers of two.
constexpr std::size_t BLOCK = 128, LOOK_AHEAD = 8;

/// Lanes that no criterion rejects, of those asked so far.
template <class Lanes>
struct Passing {
  using Number = typename Lanes::Number;
  typename Lanes::Choice lanes;
  bool is_first = true;

  HWY_INLINE void apart(Number squared_distance, Number radii, Number limit) {
    keep(squared_distance <= squared(limit + radii));
  }
  HWY_INLINE void above(Number z, Number slab, Number limit, Of /*of*/) { keep(z <= limit + slab); }
  HWY_INLINE void outside(Number z, Number slab, Number limit, Of /*of*/) {
    keep(magnitude(z) <= limit + slab);
  }
  HWY_INLINE void behind(Number z, Number slab, Of /*of*/) { keep(z + slab >= Lanes::set(0.0F)); }
  HWY_INLINE void beside(const typename NodeCriteria<Lanes>::Beside& x, Of /*of*/) {
    keep(x.squared_lateral * squared(x.cosine) <= squared(x.side));
  }
  HWY_INLINE void across(Number gap, Number limit, Number /*along*/, Of /*of*/) { keep(gap <= limit); }
  HWY_INLINE void turned(Number cosines) { keep(cosines <= Lanes::set(0.0F)); }

 private:
  static HWY_INLINE Number squared(Number x) { return x * x; }
  HWY_INLINE void keep(typename Lanes::Choice passed) {
    lanes = is_first ? passed : both_of(lanes, passed);
    is_first = false;
  }
};

/// The test of wide_node_test.h.
/// @param widths  WideWidthTest or NoWidths
template <class Lanes, class Widths>
HWY_INLINE WideMasks test_lanes(const WideNode& node, const WidePlaces& places, const WideProbe& probe,
                                const WideLimits& limits, const Widths& widths) {
  WideMasks masks;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count()) {
    const LaneBounds<Lanes> bounds(node, places, first, probe, limits.rounding);
    const NodeCriteria<Lanes> criteria(bounds, limits);
    Passing<Lanes> near, touch, collinear, directed;
    criteria.near(near);
    criteria.near_touch(touch);
    const std::uint32_t used_bits = Lanes::bits(Lanes::not_zero(node.child, first), first);
    masks.used |= used_bits;
    // Where nothing is near enough no direction matters (early out, lemma 7).
    if (((Lanes::bits(touch.lanes, first) | Lanes::bits(near.lanes, first)) & used_bits) == 0) {
      masks.beyond |= used_bits;
      continue;
    }
    criteria.collinear(collinear);
    criteria.directed(directed);
    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      const LaneWidths<Lanes> across(bounds, node, places, first, probe, widths, limits.rounding);
      criteria.apart_across(across, directed, touch);
    }

    const std::uint32_t touch_bits = Lanes::bits(touch.lanes, first) & used_bits;
    const std::uint32_t near_bits = Lanes::bits(near.lanes, first) & used_bits;
    const std::uint32_t collinear_bits = Lanes::bits(collinear.lanes, first);
    masks.touch |= touch_bits;
    masks.lmd |= near_bits & collinear_bits & Lanes::bits(directed.lanes, first);
    masks.beyond |= used_bits & ~touch_bits & ~near_bits;
    masks.not_collinear |= near_bits & ~touch_bits & ~collinear_bits;
  }
  LMDBENCH_ENSURES(((masks.lmd | masks.touch) & (masks.beyond | masks.not_collinear)) == 0 &&
                       (masks.beyond & masks.not_collinear) == 0 &&
                       ((masks.lmd | masks.touch | masks.beyond | masks.not_collinear) & ~masks.used) == 0,
                   "a lane with two outcomes");
  return masks;
}

struct VectorTest {
  template <class Widths>
  HWY_INLINE WideMasks operator()(const WideNode& node, const WidePlaces& places, const WideProbe& probe,
                                  const WideLimits& limits, const Widths& widths) const {
    return test_lanes<VectorLanes>(node, places, probe, limits, widths);
  }
};

struct ScalarTest {
  WideMasks operator()(const WideNode& node, const WidePlaces& places, const WideProbe& probe,
                       const WideLimits& limits, const NoWidths&) const {
    return test_lanes_scalar(node, probe, limits, nullptr, &places);
  }
  WideMasks operator()(const WideNode& node, const WidePlaces& places, const WideProbe& probe,
                       const WideLimits& limits, const WideWidthTest& widths) const {
    return test_lanes_scalar(node, probe, limits, &widths, &places);
  }
};

/// Lanes with more to gain than the probe; of equal gains the second mesh's child is opened.
HWY_INLINE std::uint32_t lanes_that_gain_more(const WideNode& node, float of_probe, bool lanes_are_first) {
  std::uint32_t bits = 0;
  const VectorNumber probe = VectorLanes::set(of_probe);
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += VectorLanes::count()) {
    // opening_gain
    const VectorNumber gain = VectorLanes::load(node.radius + first) *
                              (VectorLanes::set(CONE_GAIN) + VectorLanes::load(node.sine + first));
    bits |=
        lanes_are_first ? VectorLanes::bits(gain > probe, first) : VectorLanes::bits(gain >= probe, first);
  }
  return bits;
}

/// A lane as probe, where it is.
HWY_INLINE WideProbe probe_of(const WideNode& node, const WidePlaces& places, std::uint32_t lane) {
  return {{places.centre[0][lane], places.centre[1][lane], places.centre[2][lane], 0.0F},
          {places.axis[0][lane], places.axis[1][lane], places.axis[2][lane], 0.0F},
          node.radius[lane],
          node.thickness[lane],
          node.cosine[lane],
          node.sine[lane]};
}

/// A query's descent. Pairs that open a child of the first mesh and of the second have a stack each
/// and are tested a block at a time: no branch depends on which it is, or on what survives, but for
/// far nodes and found pairs, so a processor works on several tests at once.
/// @tparam Widths  WideWidthTest where one of the meshes has long features, else NoWidths
template <class Test, class Widths>
class Descent {
 public:
  Descent(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, WideScratch& scratch)
      : a_(a), b_(b), query_(query), scratch_(scratch), moved_(a, query.a_in_b, scratch.moved) {}

  WideCounters run() {
    scratch_.opening_a.size = scratch_.opening_b.size = 0;
    WideStack& first = choose_opening(a_, b_, 0, 0).open_a ? scratch_.opening_a : scratch_.opening_b;
    first.reserve_more(1);
    first.a[0] = first.b[0] = 0;
    first.size = 1;
    while (scratch_.opening_a.size + scratch_.opening_b.size != 0) {
      if (scratch_.opening_a.size > scratch_.opening_b.size)
        test_block<true>(scratch_.opening_a);
      else
        test_block<false>(scratch_.opening_b);
    }
    count_.rejected_g3 = count_.node_pairs - survivors_ - count_.rejected_g1 - count_.rejected_g2;
    return count_;
  }

 private:
  template <bool OpensA>
  void test_block(WideStack& from) {
    const std::size_t count = std::min(from.size, BLOCK);
    from.size -= count;
    scratch_.opening_a.reserve_more((count + 1) * WIDE_WIDTH);
    scratch_.opening_b.reserve_more((count + 1) * WIDE_WIDTH);
    // Whole vectors: they read less than one vector beyond the last.
    const hn::RebindToUnsigned<FloatTag> u;
    std::array<std::uint32_t, BLOCK> slots_a, slots_b;
    for (std::size_t i = 0; i < count; i += hn::Lanes(u)) {
      hn::StoreU(hn::LoadU(u, from.a.data() + from.size + i), u, slots_a.data() + i);
      hn::StoreU(hn::LoadU(u, from.b.data() + from.size + i), u, slots_b.data() + i);
    }
    std::array<std::uint32_t, LOOK_AHEAD> opened;  // Places of moved nodes, or nodes.
    const auto look_at = [&](std::size_t i) HWY_ATTR {
      std::uint32_t& node = opened[i % LOOK_AHEAD];
      if constexpr (OpensA) {
        node = moved_.child(slots_a[i]);
        fetch(moved_.node(node));
      } else {
        const std::uint32_t slot = slots_b[i];
        node = WideRef::from_bits(b_.nodes[slot / WIDE_WIDTH].child[slot % WIDE_WIDTH]).node_index();
        fetch(b_.nodes[node]);
      }
    };
    for (std::size_t ahead = 0; ahead < count + LOOK_AHEAD; ++ahead) {
      if (ahead >= LOOK_AHEAD)
        test_pair<OpensA>(opened[ahead % LOOK_AHEAD], (OpensA ? slots_b : slots_a)[ahead - LOOK_AHEAD]);
      if (ahead < count) look_at(ahead);
    }
    count_.node_tests += count;
  }

  /// Tests the children of a node against the child in a slot of the other mesh.
  template <bool OpensA>
  HWY_INLINE void test_pair(std::uint32_t opened, std::uint32_t probe_slot) {
    const WideMovedNode& moved_a = moved_[OpensA ? opened : probe_slot / WIDE_WIDTH];
    const std::uint32_t index_b = OpensA ? probe_slot / WIDE_WIDTH : opened, lane = probe_slot % WIDE_WIDTH;
    const WideNode &node_a = a_.nodes[moved_a.node], &node_b = b_.nodes[index_b];
    const WideWidths &widths_a = widths_of(a_, moved_a.node), &widths_b = widths_of(b_, index_b);
    const WidePlaces places_a(moved_a.centre, moved_a.axis,
                              a_.widths.empty() ? widths_a.across : moved_a.across);
    const WidePlaces places_b(node_b.centre, node_b.axis, widths_b.across);
    const WideNode &node = OpensA ? node_a : node_b, &home = OpensA ? node_b : node_a;
    const WidePlaces &places = OpensA ? places_a : places_b, &probe_places = OpensA ? places_b : places_a;
    const WideProbe probe = probe_of(home, probe_places, lane);

    WideMasks masks;
    if constexpr (std::is_same_v<Widths, WideWidthTest>) {
      const WideWidths &lanes = OpensA ? widths_a : widths_b, &of_probe = OpensA ? widths_b : widths_a;
      const WideWidthTest widths{
          lanes,
          {probe_places.across[0][lane], probe_places.across[1][lane], probe_places.across[2][lane]},
          of_probe.half_width[lane]};
      masks = Test{}(node, places, probe, query_.limits, widths);
    } else {
      masks = Test{}(node, places, probe, query_.limits, NoWidths());
    }
    const auto number_of = [](std::uint32_t lanes) {
      return static_cast<std::uint64_t>(std::popcount(lanes));
    };
    count_.node_pairs += number_of(masks.used);
    count_.rejected_g1 += number_of(masks.beyond);
    if (masks.beyond == masks.used) return;
    count_.rejected_g2 += number_of(masks.not_collinear);
    survivors_ += number_of(masks.lmd | masks.touch);

    // All lanes where the probe is a feature, or a face; else none.
    const WideRef probe_ref = WideRef::from_bits(home.child[lane]);
    const std::uint32_t of_feature = 0u - static_cast<std::uint32_t>(probe_ref.is_feature()),
                        of_face = 0u - static_cast<std::uint32_t>(probe_ref.is_face());
    // Touching matters for faces alone.
    const KindBits kinds = kind_bits(node);
    const std::uint32_t touch = masks.touch & (kinds.faces | ~kinds.features) & (of_face | ~of_feature);
    const std::uint32_t alive = masks.lmd | touch, found = alive & kinds.features & of_feature;
    // As choose_opening: the child with more to gain, where neither is a feature.
    const std::uint32_t opens_lane =
        of_feature |
        (lanes_that_gain_more(node, opening_gain(probe.radius, probe.sine), OpensA) & ~kinds.features);
    const std::uint32_t opens_a = OpensA ? opens_lane : ~opens_lane;
    push<OpensA>(scratch_.opening_a, alive & ~found & opens_a, opened, probe_slot);
    push<OpensA>(scratch_.opening_b, alive & ~found & ~opens_a, opened, probe_slot);

    for (std::uint32_t left = found; left != 0; left &= left - 1) {
      const auto one = static_cast<std::uint32_t>(std::countr_zero(left));
      const WideRef child = WideRef::from_bits(node.child[one]);
      const WidePair pair = OpensA ? WidePair{child, probe_ref} : WidePair{probe_ref, child};
      if ((masks.lmd >> one & 1u) != 0) scratch_.lmd_pairs.push_back(pair);
      if ((touch >> one & 1u) != 0) scratch_.touch_pairs.push_back(pair);
    }
  }

  /// Writes eight entries and keeps as many as there are lanes.
  template <bool OpensA>
  static HWY_INLINE void push(WideStack& to, std::uint32_t lanes, std::uint32_t opened,
                              std::uint32_t probe_slot) {
    const hn::RebindToUnsigned<FloatTag> u;
    const LaneList& list = LANE_LISTS[lanes];
    std::uint32_t* const slots = (OpensA ? to.a : to.b).data() + to.size;
    std::uint32_t* const probes = (OpensA ? to.b : to.a).data() + to.size;
    for (std::size_t first = 0; first < WIDE_WIDTH; first += hn::Lanes(u)) {
      const auto chosen =
          hn::PromoteTo(u, hn::LoadU(hn::Rebind<std::uint8_t, decltype(u)>(), list.lane.data() + first));
      hn::StoreU(hn::Add(chosen, hn::Set(u, WIDE_WIDTH * opened)), u, slots + first);
      hn::StoreU(hn::Set(u, probe_slot), u, probes + first);
    }
    to.size += list.count;
  }

  const WideHierarchy &a_, &b_;
  const WideQuery& query_;
  WideScratch& scratch_;
  MovedNodes moved_;
  WideCounters count_;
  std::uint64_t survivors_ = 0;
};

template <class Test>
void descend_by(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, WideScratch& scratch,
                WideCounters& counters) {
  counters = a.widths.empty() && b.widths.empty() ? Descent<Test, NoWidths>(a, b, query, scratch).run()
                                                  : Descent<Test, WideWidthTest>(a, b, query, scratch).run();
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
  masks = widths == nullptr ? VectorTest{}(node, WidePlaces(node, NoWidths()), probe, limits, NoWidths())
                            : VectorTest{}(node, WidePlaces(node, *widths), probe, limits, *widths);
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

WideQuery::WideQuery(const WideHierarchy& a, const WideHierarchy& b, const RigidTransform& X_BA, double reach,
                     double touch) {
  const Vec3 p_BA = X_BA.point(a.origin) - b.origin;  // a's origin in b's hierarchy frame
  const double between = p_BA.norm();
  const double size = between + a.radius + b.radius;
  possible = !a.nodes.empty() && !b.nodes.empty() &&
             between <= (a.radius + b.radius + std::max(reach, touch)) * (1.0 + POSITION_ROUNDING);
  if (!possible) return;
  a_in_b = WideTransform(X_BA.rotation, p_BA);
  b_in_a = WideTransform(X_BA.rotation.transpose(), -(X_BA.rotation.transpose() * p_BA));
  // The rounding of the two origins in the mesh frames is that of double precision, but
  // grows with their coordinates.
  const double far_away = 1e-15 * (X_BA.translation.norm() + a.origin.norm() + b.origin.norm());
  limits.reach = round_up_to_single(std::min(reach, 2.0 * size));
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
                            const WideWidthTest* widths, const WidePlaces* places) {
  using HWY_NAMESPACE::ScalarLanes, HWY_NAMESPACE::test_lanes;
  if (widths == nullptr)
    return test_lanes<ScalarLanes>(node, places != nullptr ? *places : WidePlaces(node, NoWidths()), probe,
                                   limits, NoWidths());
  return test_lanes<ScalarLanes>(node, places != nullptr ? *places : WidePlaces(node, *widths), probe, limits,
                                 *widths);
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
