// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance_steps.h>

#include <cstdint>

// Vectors of unknown length cannot be members of structures.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/geometry/feature_guess.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/geometry/lane_vector-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// Without vectors a guess costs more than it saves.
kernel::FeatureGuess guess(const Triangle&, const Triangle&, double) {
  return {};
}

#else

/// Four lanes: one a corner or edge of a triangle; the fourth repeats the first.
using Quad = hn::FixedTag<float, 4>;
using QuadReal = hn::Vec<Quad>;
using QuadVector = LaneVector<QuadReal>;

/// Slots of edge pairs: four times the edge of a plus the edge of b, as many at a time as a
/// register holds. The last of three fours is repeated to fill the widest register.
constexpr std::size_t SLOTS = 16;
using Wide = hn::CappedTag<float, SLOTS>;
using WideReal = hn::Vec<Wide>;
using WideVector = LaneVector<WideReal>;

HWY_INLINE QuadReal quad(const Triangle& t, int axis, double origin) {
  using Two = hn::FixedTag<double, 2>;
  const Two two;
  const hn::Half<Quad> half;
  const auto start = hn::Set(two, origin);
  const auto first = hn::Set(two, t[0][axis]);
  const auto low = hn::Sub(hn::InterleaveLower(two, first, hn::Set(two, t[1][axis])), start);
  const auto high = hn::Sub(hn::InterleaveLower(two, hn::Set(two, t[2][axis]), first), start);
  return hn::Combine(Quad(), hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

HWY_INLINE QuadVector quad(const Triangle& t, const Vec3& origin, QuadReal scale) {
  return times(scale, QuadVector{quad(t, 0, origin[0]), quad(t, 1, origin[1]), quad(t, 2, origin[2])});
}

/// The vector of the next corner.
HWY_INLINE QuadReal next(QuadReal x) {
  alignas(16) constexpr std::int32_t NEXT[4] = {1, 2, 0, 1};
  return hn::TableLookupLanes(x, hn::SetTableIndices(Quad(), NEXT));
}
HWY_INLINE QuadVector next(const QuadVector& v) {
  return {next(v.x), next(v.y), next(v.z)};
}
template <int K>
HWY_INLINE QuadVector spread(const QuadVector& v) {
  return {hn::Broadcast<K>(v.x), hn::Broadcast<K>(v.y), hn::Broadcast<K>(v.z)};
}

/// Part of an edge or face from which single precision tells an inner point from the border. A
/// point nearer to the border is taken to be on it: one more step leads inside from there.
constexpr float CLEARLY = 1e-3F;

/// The corners of one triangle over the face of the other.
struct OverFace {
  QuadReal squared_height;  ///< infinite where the corner is not over the inside
  hn::Mask<Quad> pierces;   ///< the edge from this corner to the next clearly pierces the face
};

HWY_INLINE OverFace over_face(const QuadVector& t, const QuadVector& face, const QuadVector& edges) {
  const QuadReal zero = hn::Zero(Quad());
  const QuadVector e1 = spread<0>(edges);
  const QuadVector e3 = spread<2>(edges);  // from corner 2 to corner 0
  const QuadVector n = cross(e3, e1);
  const QuadVector w = t - spread<0>(face);
  const QuadReal squared_n = dot(n, n);
  const QuadReal height = dot(w, n);
  const QuadReal part = hn::Div(height, squared_n);
  const QuadReal w1 = dot(w, cross(n, e3));
  const QuadReal w2 = dot(w, cross(n, e1));
  const QuadReal w0 = hn::Sub(hn::Sub(squared_n, w1), w2);
  const QuadReal least = hn::Min(w0, hn::Min(w1, w2));
  OverFace result;
  result.squared_height = hn::IfThenElse(hn::Gt(least, hn::Mul(hn::Set(Quad(), CLEARLY), squared_n)),
                                         hn::Mul(height, part), hn::Set(Quad(), HUGE_VALF));
  // Where an edge meets the plane: heights of its ends and weights there, both times the edge's
  // drop. All have the drop's sign where the edge pierces the face.
  const QuadReal next_part = next(part);
  const QuadReal drop = hn::Sub(part, next_part);
  const auto at_plane = [&](QuadReal weight) {
    return hn::Sub(hn::Mul(part, next(weight)), hn::Mul(next_part, weight));
  };
  const QuadReal v0 = at_plane(w0), v1 = at_plane(w1), v2 = at_plane(w2);
  const QuadReal limit = hn::Mul(hn::Set(Quad(), CLEARLY), drop);
  const QuadReal weight_limit = hn::Mul(limit, squared_n);
  const QuadReal from_plane = hn::Neg(next_part);
  const auto falls = hn::And(hn::Gt(drop, zero), hn::And(hn::Gt(hn::Min(part, from_plane), limit),
                                                         hn::Gt(hn::Min(v0, hn::Min(v1, v2)), weight_limit)));
  const auto rises = hn::And(hn::Lt(drop, zero), hn::And(hn::Lt(hn::Max(part, from_plane), limit),
                                                         hn::Lt(hn::Max(v0, hn::Max(v1, v2)), weight_limit)));
  result.pierces = hn::Or(falls, rises);
  return result;
}

HWY_INLINE WideReal repeated(QuadReal x) {
  alignas(16) float lanes[4];
  hn::Store(x, Quad(), lanes);
  return hn::LoadDup128(Wide(), lanes);
}
HWY_INLINE WideVector repeated(const QuadVector& v) {
  return {repeated(v.x), repeated(v.y), repeated(v.z)};
}

HWY_INLINE WideReal clamp01(WideReal x) {
  return hn::Min(hn::Max(x, hn::Zero(Wide())), hn::Set(Wide(), 1.0F));
}

/// Nearest points of all edge pairs.
struct EdgePairs {
  alignas(64) float s[SLOTS];
  alignas(64) float t[SLOTS];
  alignas(64) float squared_distance[SLOTS];
};

HWY_INLINE float examine_edge_pairs(const QuadVector& a, const QuadVector& edges_a, const QuadVector& b,
                                    const QuadVector& edges_b, EdgePairs& pairs) {
  alignas(64) constexpr std::int32_t EDGE_OF_A[SLOTS] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2};
  const Wide wide;
  const WideReal one = hn::Set(wide, 1.0F);
  const WideVector all_a = repeated(a), all_edges_a = repeated(edges_a);
  const WideVector b0 = repeated(b), d2 = repeated(edges_b);
  const WideReal squared_2 = dot(d2, d2);
  const WideReal inverse_2 = hn::Div(one, squared_2);
  WideReal nearest = hn::Set(wide, HUGE_VALF);
  for (std::size_t slot = 0; slot < 12; slot += hn::Lanes(wide)) {
    const auto pick = hn::SetTableIndices(wide, EDGE_OF_A + slot);
    const auto picked = [pick](const WideVector& v) {
      return WideVector{hn::TableLookupLanes(v.x, pick), hn::TableLookupLanes(v.y, pick),
                        hn::TableLookupLanes(v.z, pick)};
    };
    const WideVector d1 = picked(all_edges_a);
    const WideVector r = b0 - picked(all_a);
    const WideReal squared_1 = dot(d1, d1);
    const WideReal m = dot(d1, d2), c1 = dot(d1, r), c2 = dot(d2, r);
    const WideReal determinant = hn::Sub(hn::Mul(squared_1, squared_2), hn::Mul(m, m));
    const WideReal t_lines = clamp01(hn::Div(hn::Sub(hn::Mul(c1, m), hn::Mul(c2, squared_1)), determinant));
    const WideReal s_there = hn::Div(hn::Add(c1, hn::Mul(t_lines, m)), squared_1);
    const WideReal s = clamp01(s_there);
    const WideReal t_back = clamp01(hn::Mul(hn::Sub(hn::Mul(s, m), c2), inverse_2));
    const WideReal t = hn::IfThenElse(hn::Eq(s, s_there), t_lines, t_back);
    const WideVector d = (r + times(t, d2)) - times(s, d1);
    const WideReal squared_distance = dot(d, d);
    hn::Store(s, wide, pairs.s + slot);
    hn::Store(t, wide, pairs.t + slot);
    hn::Store(squared_distance, wide, pairs.squared_distance + slot);
    nearest = hn::Min(nearest, squared_distance);
  }
  return hn::GetLane(hn::MinOfLanes(wide, nearest));
}

HWY_INLINE int first_lane_equal(QuadReal x, float value) {
  return static_cast<int>(hn::FindFirstTrue(Quad(), hn::Eq(x, hn::Set(Quad(), value)))) % 3;
}

/// Number of the edge pair at this distance.
HWY_INLINE int first_slot_equal(const EdgePairs& pairs, float value) {
  const Wide wide;
  for (std::size_t slot = 0; slot < 12; slot += hn::Lanes(wide)) {
    const auto lane =
        hn::FindFirstTrue(wide, hn::Eq(hn::Load(wide, pairs.squared_distance + slot), hn::Set(wide, value)));
    if (lane >= 0) return static_cast<int>(slot) + static_cast<int>(lane);
  }
  return 0;
}

HWY_INLINE kernel::Carriers carriers_of_edge(int edge, float parameter) {
  const int end = edge == 2 ? 0 : edge + 1;
  kernel::Carriers result = kernel::Carriers::two(edge, end);
  if (parameter < CLEARLY) result.count = 1;
  if (parameter > 1.0F - CLEARLY) result.keep_only(end);
  return result;
}

kernel::FeatureGuess guess(const Triangle& triangle_a, const Triangle& triangle_b, double scale) {
  const QuadReal scales = hn::Set(Quad(), static_cast<float>(scale));
  const QuadVector a = quad(triangle_a, triangle_a[0], scales);
  const QuadVector b = quad(triangle_b, triangle_a[0], scales);
  const QuadVector edges_a = next(a) - a;
  const QuadVector edges_b = next(b) - b;
  const OverFace a_over_b = over_face(a, b, edges_b);
  const OverFace b_over_a = over_face(b, a, edges_a);
  if (!hn::AllFalse(Quad(), hn::Or(a_over_b.pierces, b_over_a.pierces))) return {};
  EdgePairs pairs;
  const float by_edges = examine_edge_pairs(a, edges_a, b, edges_b, pairs);
  const float by_a = hn::GetLane(hn::MinOfLanes(Quad(), a_over_b.squared_height));
  const float by_b = hn::GetLane(hn::MinOfLanes(Quad(), b_over_a.squared_height));
  using kernel::Carriers;
  if (by_a < by_edges && by_a <= by_b) {
    return {Carriers::one(first_lane_equal(a_over_b.squared_height, by_a)), Carriers::all(), true};
  }
  if (by_b < by_edges) {
    return {Carriers::all(), Carriers::one(first_lane_equal(b_over_a.squared_height, by_b)), true};
  }
  const int slot = first_slot_equal(pairs, by_edges);
  return {carriers_of_edge(slot / 4, pairs.s[slot]), carriers_of_edge(slot % 4 % 3, pairs.t[slot]), true};
}

#endif

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(guess);

kernel::FeatureGuess kernel::guess_features(const Triangle& a, const Triangle& b, double scale) {
  return HWY_DYNAMIC_DISPATCH(guess)(a, b, scale);
}

}  // namespace lmdbench

#endif  // HWY_ONCE
