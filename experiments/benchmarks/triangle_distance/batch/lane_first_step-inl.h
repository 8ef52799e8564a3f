// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Stage of triangle_distance_batch: nearest corners and the edges from there that lead ahead. Included once
// for every instruction set.
#if defined(LMDBENCH_LANE_FIRST_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_FIRST_STEP_INL
#undef LMDBENCH_LANE_FIRST_STEP_INL
#else
#define LMDBENCH_LANE_FIRST_STEP_INL
#endif

#include <lmdbench/geometry/lane_triangle-inl.h>
#include <lmdbench/geometry/lane_turned-inl.h>

#include <benchmarks/triangle_distance/batch/lane_segments-inl.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

HWY_INLINE Turned turned(const Three<Vector>& t, const Vector& direction) {
  const Real h0 = dot(t.v[0], direction), h1 = dot(t.v[1], direction), h2 = dot(t.v[2], direction);
  const Mask first_is_2 = hn::Gt(h2, hn::Max(h0, h1));
  return turned(t, hn::AndNot(first_is_2, hn::Gt(h1, h0)), first_is_2);
}

/// The edge from the first corner to the neighbour that is steepest ahead along d;
/// none where neither is ahead.
struct Way {
  Vector edge;
  Mask to_second, to_third;
};

HWY_INLINE Way way_ahead(const Turned& t, const Vector& d) {
  const Vector to_second = t.corner.v[1] - t.corner.v[0];
  const Vector to_third = t.corner.v[2] - t.corner.v[0];
  const Real ahead_second = dot(to_second, d);
  const Real ahead_third = dot(to_third, d);
  const Real steep_second = hn::Mul(hn::Mul(ahead_second, hn::Abs(ahead_second)), dot(to_third, to_third));
  const Real steep_third = hn::Mul(hn::Mul(ahead_third, hn::Abs(ahead_third)), dot(to_second, to_second));
  Way way;
  way.to_third = hn::And(hn::Gt(ahead_third, zero()), hn::Gt(steep_third, steep_second));
  way.to_second = hn::AndNot(way.to_third, hn::Gt(ahead_second, zero()));
  const Vector none{zero(), zero(), zero()};
  way.edge = select(way.to_third, to_third, select(way.to_second, to_second, none));
  return way;
}

/// Weights and point at `part` of the way.
HWY_INLINE void place(const Turned& t, const Way& way, Real part, Three<Real>& weights, Vector& point) {
  const Real one = constant(1.0);
  const Mask moved = hn::Or(way.to_second, way.to_third);
  const Real to = select(moved, part, zero());
  const Mask at_end = hn::And(moved, hn::Eq(part, one));
  const Vector end = select(way.to_third, t.corner.v[2], t.corner.v[1]);
  point = select(at_end, end, t.corner.v[0] + times(to, way.edge));
  const Three<Real> turned_weights{
      {hn::Sub(one, to), select(way.to_second, to, zero()), select(way.to_third, to, zero())}};
  weights = turned_back(t, turned_weights);
}

std::uint32_t first_step(const LaneBlock& block, LaneResult& result) {
  std::uint32_t done = 0;
  for (std::size_t lane = 0; lane < MAX_LANES; lane += hn::Lanes(Lanes())) {
    const Three<Vector> a = load(block.a, lane);
    const Three<Vector> b = load(block.b, lane);
    const Vector toward_b = (b.v[0] + b.v[1] + b.v[2]) - (a.v[0] + a.v[1] + a.v[2]);
    const Vector toward_a = times(constant(-1.0), toward_b);
    const Turned turned_a = turned(a, toward_b);
    const Turned turned_b = turned(b, toward_a);
    const Vector d = turned_b.corner.v[0] - turned_a.corner.v[0];
    const Way way_a = way_ahead(turned_a, d);
    const Way way_b = way_ahead(turned_b, times(constant(-1.0), d));
    const Parameters nearest = nearest_on_segments(d, way_a.edge, way_b.edge);
    Found found;
    place(turned_a, way_a, nearest.s, found.weights_a, found.point_a);
    place(turned_b, way_b, nearest.t, found.weights_b, found.point_b);
    found.squared_rise = nearest.squared_rise;
    done |= bits(proved(a, b, found), lane);
    store(found, lane, result);
  }
  return done;
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
