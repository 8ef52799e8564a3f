// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Gaps between triangles in lanes. Included once for every instruction set.
#if defined(LMDBENCH_LANE_GAP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_GAP_INL
#undef LMDBENCH_LANE_GAP_INL
#else
#define LMDBENCH_LANE_GAP_INL
#endif

#include <lmdbench/methods/certified/decide/lane_triangle-inl.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

/// The best axis of each lane so far. An axis needs no accuracy: only the extents along it must be
/// right, and these are off by roundings of the coordinates.
struct BestGap {
  Real squared_gap, squared_length;  ///< Of the gap (0: no gap) and of the axis.
  Vector axis;                       ///< From a towards b.

  /// @param a1, a2, b corners less a's first one
  HWY_INLINE void offer(const Vector& candidate, const Vector& a1, const Vector& a2, const Three<Vector>& b) {
    const Real on_a1 = dot(candidate, a1), on_a2 = dot(candidate, a2);
    const Real on_b0 = dot(candidate, b.v[0]), on_b1 = dot(candidate, b.v[1]), on_b2 = dot(candidate, b.v[2]);
    const Real low_a = hn::Min(zero(), hn::Min(on_a1, on_a2));
    const Real high_a = hn::Max(zero(), hn::Max(on_a1, on_a2));
    const Real ahead = hn::Sub(hn::Min(on_b0, hn::Min(on_b1, on_b2)), high_a);
    const Real behind = hn::Sub(low_a, hn::Max(on_b0, hn::Max(on_b1, on_b2)));
    const Real gap = hn::Max(ahead, behind);
    const Real squared = dot(candidate, candidate);
    const Mask is_gap = hn::And(hn::Gt(gap, zero()), hn::Gt(squared, zero()));
    const Real squared_of_gap = hn::Div(hn::Mul(gap, gap), select(is_gap, squared, constant(1.0)));
    const Mask better = hn::And(is_gap, hn::Gt(squared_of_gap, squared_gap));
    const Vector minus = {hn::Neg(candidate.x), hn::Neg(candidate.y), hn::Neg(candidate.z)};
    squared_gap = select(better, squared_of_gap, squared_gap);
    squared_length = select(better, squared, squared_length);
    axis = select(better, select(hn::Ge(ahead, behind), candidate, minus), axis);
  }
};

/// The largest gap along the normals and the products of two sides (0: no gap), and its axis.
inline void clear_gap(const LaneBlock& block, LaneGap& result) {
  const Lanes d;
  for (std::size_t lane = 0; lane < MAX_LANES; lane += hn::Lanes(d)) {
    const Three<Vector> a = load(block.a, lane);
    const Three<Vector> b = load(block.b, lane);
    const Real magnitude = largest_coordinate(a, b);
    const Mask in_range = hn::And(hn::Ge(magnitude, constant(SMALLEST_COORDINATE)),
                                  hn::Le(magnitude, constant(LARGEST_COORDINATE)));
    // Everything from a's first corner: differences of nearby points, no large coordinates.
    const Vector a1 = a.v[1] - a.v[0], a2 = a.v[2] - a.v[0];
    const Three<Vector> from_a{{b.v[0] - a.v[0], b.v[1] - a.v[0], b.v[2] - a.v[0]}};
    const Three<Vector> sides_a{{a1, a2 - a1, a2}};
    const Three<Vector> sides_b{{b.v[1] - b.v[0], b.v[2] - b.v[1], b.v[2] - b.v[0]}};
    BestGap best{zero(), constant(1.0), {zero(), zero(), zero()}};
    best.offer(cross(sides_a.v[0], sides_a.v[1]), a1, a2, from_a);
    best.offer(cross(sides_b.v[0], sides_b.v[1]), a1, a2, from_a);
    for (const Vector& side_a : sides_a.v)
      for (const Vector& side_b : sides_b.v) best.offer(cross(side_a, side_b), a1, a2, from_a);
    hn::Store(hn::IfThenElseZero(in_range, hn::Sqrt(best.squared_gap)), d, result.gap + lane);
    store(times(hn::Div(constant(1.0), hn::Sqrt(best.squared_length)), best.axis), result.axis, lane);
  }
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
