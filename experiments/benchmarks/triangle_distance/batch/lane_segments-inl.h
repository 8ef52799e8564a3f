// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Nearest points of segments in lanes. Included once for every instruction set.
#if defined(LMDBENCH_LANE_SEGMENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_SEGMENTS_INL
#undef LMDBENCH_LANE_SEGMENTS_INL
#else
#define LMDBENCH_LANE_SEGMENTS_INL
#endif

#include <lmdbench/geometry/lane_triangle-inl.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

/// Nearest points p0 + s d1 and q0 + t d2 of two segments, as in ordered_segment_distance; a zero d1 or d2
/// makes a point of its segment.
struct Parameters {
  Real s, t;
  Real squared_rise;  ///< 0 where the segments are nearly parallel
};

HWY_INLINE Parameters nearest_on_segments(const Vector& r, const Vector& d1, const Vector& d2) {
  const Real one = constant(1.0);
  const Real squared_1 = dot(d1, d1);
  const Real squared_2 = dot(d2, d2);
  const Mask is_edge_1 = hn::Gt(squared_1, zero());
  const Mask is_edge_2 = hn::Gt(squared_2, zero());
  const Real inverse_1 = hn::Div(one, select(is_edge_1, squared_1, one));
  const Real inverse_2 = hn::Div(one, select(is_edge_2, squared_2, one));
  const Real mu = hn::Mul(dot(d1, d2), inverse_1);
  const Real sigma = hn::Mul(dot(d1, r), inverse_1);
  const Vector d2_across = d2 - times(mu, d1);
  const Vector r_across = r - times(sigma, d1);
  const Real squared_across = dot(d2_across, d2_across);
  const Mask has_angle = hn::Gt(squared_across, zero());
  const Real t_lines = hn::Neg(hn::Div(dot(r_across, d2_across), select(has_angle, squared_across, one)));
  const Real t_clamped = clamp01(t_lines);
  const Real s_there = hn::Add(sigma, hn::Mul(t_clamped, mu));
  const Real s = clamp01(s_there);
  // Where s met an end, project that end back.
  const Real t_back = clamp01(hn::Mul(dot(times(s, d1) - r, d2), inverse_2));
  const Real t = select(hn::Eq(s, s_there), t_clamped, t_back);
  const Mask inside_s = hn::And(hn::Gt(s, zero()), hn::Lt(s, one));
  const Mask inside_t = hn::And(hn::Gt(t, zero()), hn::Lt(t, one));
  const Mask both = hn::And(inside_s, inside_t);
  const Real squared_sine = hn::Mul(squared_across, inverse_2);
  const Real infinite = constant(HUGE_VAL);
  const Real rise_s = select(inside_s, hn::Mul(squared(hn::Min(s, hn::Sub(one, s))), squared_1), infinite);
  const Real rise_t = select(inside_t, hn::Mul(squared(hn::Min(t, hn::Sub(one, t))), squared_2), infinite);
  const Real slope = select(both, squared_sine, one);
  const Mask flat = hn::And(both, hn::Lt(squared_sine, constant(MIN_SQUARED_SINE)));
  return {s, t, select(flat, zero(), hn::Mul(hn::Min(rise_s, rise_t), slope))};
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
