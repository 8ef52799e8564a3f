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
/// Entries of a queue that has never been used, and moved nodes; they grow by doubling.
constexpr std::size_t QUEUE_START = 4096, MOVED_START = 256;
/// Of an entry of queue_b: the first child is opened.
constexpr int OPEN_A_SHIFT = 31;
static_assert(WideRef::INDEX_MASK / WIDE_WIDTH < (1u << OPEN_A_SHIFT) / WIDE_WIDTH,
              "a slot fits below the bit");

/// The test of wide_node_test.h.
/// @param widths  WideWidthTest or NoWidths
template <class Lanes, class Widths>
HWY_INLINE WideMasks test_lanes(const WideNode& node, const WidePlaces& places, const WideProbe& probe,
                                const WideLimits& limits, const Widths& widths) {
  using Number = typename Lanes::Number;
  const auto squared = [](Number x) HWY_ATTR { return x * x; };
  const Number zero = Lanes::set(0.0F);
  const Number cutoff = Lanes::set(limits.cutoff);
  const Number touch_limit = Lanes::set(limits.touch);
  WideMasks masks;
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += Lanes::count()) {
    const LaneBounds<Lanes> bounds(node, places, first, probe, limits.rounding);
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
      const LaneWidths<Lanes> across(bounds, node, places, first, probe, widths, limits.rounding);
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

/// Moves rows of points, or of directions where the translation is zero.
HWY_INLINE void move_rows(const float (*from)[WIDE_WIDTH], const WideTransform& X, const float* translation,
                          float (*to)[WIDE_WIDTH]) {
  for (std::uint32_t first = 0; first < WIDE_WIDTH; first += VectorLanes::count()) {
    const VectorNumber x = VectorLanes::load(from[0] + first), y = VectorLanes::load(from[1] + first),
                       z = VectorLanes::load(from[2] + first);
    for (int i = 0; i < 3; ++i) {
      const VectorNumber turned =
          (VectorLanes::set(X.columns[0][i]) * x + VectorLanes::set(X.columns[1][i]) * y) +
          VectorLanes::set(X.columns[2][i]) * z;
      const VectorNumber moved = turned + VectorLanes::set(translation[i]);
      hn::Store(moved.raw, FloatTag(), to[i] + first);
    }
  }
}

/// The nodes of the first hierarchy that a query has met.
class MovedNodes {
 public:
  MovedNodes(const WideHierarchy& a, const WideTransform& X, std::vector<WideMovedNode>& moved)
      : a_(a), X_(X), moved_(moved) {
    if (moved_.size() < MOVED_START) moved_.resize(MOVED_START);
    append(0);
  }

  const WideMovedNode& operator[](std::uint32_t place) const { return moved_[place]; }
  const WideNode& node(std::uint32_t place) const { return a_.nodes[moved_[place].node]; }

  /// Where the child in a slot is, which is a node.
  HWY_INLINE std::uint32_t child(std::uint32_t slot) {
    const std::uint32_t known = moved_[slot / WIDE_WIDTH].moved_child[slot % WIDE_WIDTH];
    if (known != 0) return known;
    const std::uint32_t place =
        append(WideRef::from_bits(node(slot / WIDE_WIDTH).child[slot % WIDE_WIDTH]).node_index());
    moved_[slot / WIDE_WIDTH].moved_child[slot % WIDE_WIDTH] = place;
    return place;
  }

 private:
  std::uint32_t append(std::uint32_t node) {
    static constexpr float NO_TRANSLATION[3] = {};
    if (count_ == moved_.size()) moved_.resize(2 * moved_.size());
    WideMovedNode& moved = moved_[count_];
    const WideNode& own = a_.nodes[node];
    move_rows(own.centre, X_, X_.translation, moved.centre);
    move_rows(own.axis, X_, NO_TRANSLATION, moved.axis);
    if (!a_.widths.empty()) move_rows(a_.widths[node].across, X_, NO_TRANSLATION, moved.across);
    std::ranges::fill(moved.moved_child, 0u);
    moved.node = node;
    return static_cast<std::uint32_t>(count_++);
  }

  const WideHierarchy& a_;
  const WideTransform& X_;
  std::vector<WideMovedNode>& moved_;
  std::size_t count_ = 0;
};

constexpr std::uint32_t ALL_LANES = (1u << WIDE_WIDTH) - 1u;

/// Lanes that opening narrows more than the probe; of two that gain alike the second mesh's is opened.
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

/// First in, first out, without a data-dependent branch but for found pairs: a processor then works on
/// several tests at once, because none waits for what the one before it appends.
/// @tparam Widths  WideWidthTest where one of the meshes has long features, else NoWidths
template <class Test, class Widths>
void descend(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, WideScratch& scratch,
             WideCounters& counters) {
  constexpr bool HAS_WIDTHS = std::is_same_v<Widths, WideWidthTest>;
  const Test test{};
  const WideNode* const nodes_b = b.nodes.data();
  MovedNodes moved(a, query.a_in_b, scratch.moved);
  WideCounters count;
  const hn::RebindToUnsigned<FloatTag> u;
  if (scratch.queue_a.size() < QUEUE_START) scratch.resize_queue(QUEUE_START);
  scratch.queue_a[0] = 0;
  scratch.queue_b[0] = static_cast<std::uint32_t>(choose_opening(a, b, 0, 0).open_a) << OPEN_A_SHIFT;
  std::size_t end = 1, looked_at = 0;
  std::array<std::uint32_t, LOOK_AHEAD> opened;  // Places of moved nodes, or nodes.
  for (std::size_t next = 0; next < end; ++next) {
    if (end + WIDE_WIDTH > scratch.queue_a.size()) scratch.resize_queue(2 * scratch.queue_a.size());
    std::uint32_t* const queue_a = scratch.queue_a.data();
    std::uint32_t* const queue_b = scratch.queue_b.data();
    const auto slot_of_b = [&](std::size_t i) { return queue_b[i] & ~(1u << OPEN_A_SHIFT); };
    for (; looked_at < std::min(end, next + LOOK_AHEAD); ++looked_at) {
      std::uint32_t& ahead = opened[looked_at % LOOK_AHEAD];
      if (queue_b[looked_at] >> OPEN_A_SHIFT != 0) {
        ahead = moved.child(queue_a[looked_at]);
        fetch(moved.node(ahead));
      } else {
        const std::uint32_t slot = slot_of_b(looked_at);
        ahead = WideRef::from_bits(nodes_b[slot / WIDE_WIDTH].child[slot % WIDE_WIDTH]).node_index();
        fetch(nodes_b[ahead]);
      }
    }
    const std::uint32_t place = opened[next % LOOK_AHEAD];
    const bool open_a = queue_b[next] >> OPEN_A_SHIFT != 0;
    const std::uint32_t slot_a = queue_a[next], slot_b = slot_of_b(next);
    const std::uint32_t probe_slot = open_a ? slot_b : slot_a, lane = probe_slot % WIDE_WIDTH;
    const WideMovedNode& moved_a = moved[open_a ? place : slot_a / WIDE_WIDTH];
    const WideNode &node_a = a.nodes[moved_a.node], &node_b = nodes_b[open_a ? slot_b / WIDE_WIDTH : place];
    const WideWidths &widths_a = widths_of(a, moved_a.node),
                     &widths_b = widths_of(b, static_cast<std::size_t>(&node_b - nodes_b));
    const WidePlaces places_a(moved_a.centre, moved_a.axis,
                              a.widths.empty() ? widths_a.across : moved_a.across);
    const WidePlaces places_b(node_b.centre, node_b.axis, widths_b.across);
    const WideNode &node = open_a ? node_a : node_b, &home = open_a ? node_b : node_a;
    const WidePlaces &places = open_a ? places_a : places_b, &probe_places = open_a ? places_b : places_a;
    const WideProbe probe = probe_of(home, probe_places, lane);
    const WideRef probe_ref = WideRef::from_bits(home.child[lane]);

    WideMasks masks;
    if constexpr (HAS_WIDTHS) {
      const WideWidths &lanes = open_a ? widths_a : widths_b, &of_probe = open_a ? widths_b : widths_a;
      const WideWidthTest widths{
          lanes,
          {probe_places.across[0][lane], probe_places.across[1][lane], probe_places.across[2][lane]},
          of_probe.half_width[lane]};
      masks = test(node, places, probe, query.limits, widths);
    } else {
      masks = test(node, places, probe, query.limits, NoWidths());
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
    const LaneList& list = LANE_LISTS[alive & ~final_pairs];
    // As choose_opening says: the child with more to gain, where neither is a feature.
    const std::uint32_t gains_more =
        lanes_that_gain_more(node, opening_gain(probe.radius, probe.sine), open_a);
    const std::uint32_t of_lane = probe_ref.is_feature() ? ALL_LANES : gains_more & ~kinds.features;
    const std::uint32_t opens_a = open_a ? of_lane : ~of_lane;
    // Eight entries are written, as many as survive are kept.
    const std::uint32_t first_slot = WIDE_WIDTH * place;
    for (std::size_t first = 0; first < WIDE_WIDTH; first += hn::Lanes(u)) {
      const auto lanes =
          hn::PromoteTo(u, hn::LoadU(hn::Rebind<std::uint8_t, decltype(u)>(), list.lane.data() + first));
      const auto slots = hn::Add(lanes, hn::Set(u, first_slot)), probe_slots = hn::Set(u, probe_slot);
      const auto opening = hn::ShiftLeft<OPEN_A_SHIFT>(hn::Shr(hn::Set(u, opens_a), lanes));
      hn::StoreU(open_a ? slots : probe_slots, u, queue_a + end + first);
      hn::StoreU(hn::Or(open_a ? probe_slots : slots, opening), u, queue_b + end + first);
    }
    end += list.count;

    for (std::uint32_t left = alive & final_pairs; left != 0; left &= left - 1) {
      const auto found = static_cast<std::uint32_t>(std::countr_zero(left));
      const WideRef child = WideRef::from_bits(node.child[found]);
      const WidePair pair = open_a ? WidePair{child, probe_ref} : WidePair{probe_ref, child};
      if ((masks.lmd >> found & 1u) != 0) scratch.lmd_pairs.push_back(pair);
      if ((touch >> found & 1u) != 0) scratch.touch_pairs.push_back(pair);
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
