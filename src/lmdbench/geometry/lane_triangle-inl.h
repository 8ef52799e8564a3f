// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Triangle pairs in lanes, and the proof that a pair of points is the nearest. Included once for every
// instruction set, hence no ordinary include guard.
#if defined(LMDBENCH_LANE_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_TRIANGLE_INL
#undef LMDBENCH_LANE_TRIANGLE_INL
#else
#define LMDBENCH_LANE_TRIANGLE_INL
#endif

#include <lmdbench/geometry/lane_block.h>
#include <lmdbench/geometry/lane_vector-inl.h>
#include <lmdbench/geometry/tolerance.h>

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

using kernel::LaneBlock;
using kernel::LaneGap;
using kernel::LaneResult;
using kernel::MAX_LANES;

using Lanes = hn::CappedTag<double, MAX_LANES>;
using Real = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
using Vector = LaneVector<Real>;

/// Margins are this many COINCIDENCE_TOLERANCE of the largest coordinate wide, as in feature_proof.cpp.
constexpr double MARGIN = 16.0 * COINCIDENCE_TOLERANCE;
/// Edges at a smaller angle and faces with a smaller altitude (relative, squared) are left to the scalar
/// kernel: from here on the points of both kernels agree to 1e-12.
constexpr double MIN_SQUARED_SINE = 1e-4;
/// Range of coordinates in which no product overflows or loses digits, as in triangle_distance.
constexpr double SMALLEST_COORDINATE = 0x1p-100;
constexpr double LARGEST_COORDINATE = 0x1p+100;

HWY_INLINE Real constant(double x) {
  return hn::Set(Lanes(), x);
}
HWY_INLINE Real zero() {
  return hn::Zero(Lanes());
}
HWY_INLINE Real select(Mask mask, Real yes, Real no) {
  return hn::IfThenElse(mask, yes, no);
}
HWY_INLINE Real squared(Real x) {
  return hn::Mul(x, x);
}
HWY_INLINE Real clamp01(Real x) {
  return hn::Min(hn::Max(x, zero()), constant(1.0));
}
/// Three vectors or numbers, one a corner.
template <class T>
struct Three {
  T v[3];
};

HWY_INLINE Three<Vector> load(const double (&corners)[3][3][MAX_LANES], std::size_t lane) {
  const Lanes d;
  Three<Vector> result;
  for (int k = 0; k < 3; ++k) {
    result.v[k] = {hn::Load(d, corners[k][0] + lane), hn::Load(d, corners[k][1] + lane),
                   hn::Load(d, corners[k][2] + lane)};
  }
  return result;
}

HWY_INLINE Real largest_coordinate(const Three<Vector>& a, const Three<Vector>& b) {
  Real largest = zero();
  for (int k = 0; k < 3; ++k) {
    for (const Vector& p : {a.v[k], b.v[k]}) {
      largest = hn::Max(largest, hn::Max(hn::Abs(p.x), hn::Max(hn::Abs(p.y), hn::Abs(p.z))));
    }
  }
  return largest;
}

/// What a stage has found for every lane.
struct Found {
  Three<Real> weights_a, weights_b;
  Vector point_a, point_b;
  Real squared_rise;  ///< as in PointsOnSegments; infinite for two corners
};

/// The least weight of a carrier.
HWY_INLINE Real least_weight(const Three<Real>& weights) {
  Real least = constant(1.0);
  for (const Real& weight : weights.v) {
    least = hn::Min(least, select(hn::Gt(weight, zero()), weight, constant(1.0)));
  }
  return least;
}

/// The corner is behind the plane through p across d by the margin, and so are the points on the way that are
/// as far as p is from the ends of its features, in length and in parts, as in feature_proof.cpp.
HWY_INLINE Mask is_behind(const Vector& way, const Vector& d, Real squared_d, Real squared_margin,
                          Real squared_rise, Real part) {
  const Real ahead = dot(way, d);
  const Real squared_ahead = squared(ahead);
  const Real squared_way = dot(way, way);
  const Mask is_clear = hn::Gt(squared_ahead, hn::Mul(squared_margin, hn::Add(squared_way, squared_d)));
  const Mask is_steep =
      hn::Gt(hn::Mul(squared_ahead, squared_rise), hn::Mul(squared_margin, hn::Mul(squared_way, squared_d)));
  const Mask is_wide = hn::Gt(squared(hn::Mul(ahead, part)), hn::Mul(squared_margin, squared_d));
  return hn::And(hn::And(hn::Lt(ahead, zero()), is_wide), hn::And(is_clear, is_steep));
}

/// Lanes where the found pair is proved to be the one nearest pair.
HWY_INLINE Mask proved(const Three<Vector>& a, const Three<Vector>& b, const Found& found) {
  const Vector d = found.point_b - found.point_a;
  const Vector minus_d = found.point_a - found.point_b;
  const Real squared_d = dot(d, d);
  const Real magnitude = largest_coordinate(a, b);
  const Real squared_margin = squared(hn::Mul(constant(MARGIN), magnitude));
  const Real part_a = least_weight(found.weights_a), part_b = least_weight(found.weights_b);
  Mask result = hn::And(hn::Ge(magnitude, constant(SMALLEST_COORDINATE)),
                        hn::Le(magnitude, constant(LARGEST_COORDINATE)));
  for (int k = 0; k < 3; ++k) {
    const Mask behind_a =
        is_behind(a.v[k] - found.point_a, d, squared_d, squared_margin, found.squared_rise, part_a);
    const Mask behind_b =
        is_behind(b.v[k] - found.point_b, minus_d, squared_d, squared_margin, found.squared_rise, part_b);
    result = hn::And(result, hn::Or(behind_a, hn::Gt(found.weights_a.v[k], zero())));
    result = hn::And(result, hn::Or(behind_b, hn::Gt(found.weights_b.v[k], zero())));
  }
  const Mask clear = hn::And(hn::Gt(found.squared_rise, squared_margin),
                             hn::Gt(squared(found.squared_rise), hn::Mul(squared_margin, squared_d)));
  return hn::And(result, clear);
}
/// Carriers are the corners with a weight: bit k of the number says so of corner k.
HWY_INLINE Real carriers_of(const Three<Real>& weights) {
  Real result = zero();
  double bit = 1.0;
  for (const Real& weight : weights.v) {
    result = hn::Add(result, hn::IfThenElseZero(hn::Gt(weight, zero()), constant(bit)));
    bit += bit;
  }
  return result;
}

HWY_INLINE void store(const Vector& point, double (&to)[3][MAX_LANES], std::size_t lane) {
  const Lanes d;
  hn::Store(point.x, d, to[0] + lane);
  hn::Store(point.y, d, to[1] + lane);
  hn::Store(point.z, d, to[2] + lane);
}

HWY_INLINE void store(const Found& found, std::size_t lane, LaneResult& result) {
  const Lanes d;
  const Vector between = found.point_a - found.point_b;
  hn::Store(dot(between, between), d, result.squared_distance + lane);
  store(found.point_a, result.point_a, lane);
  store(found.point_b, result.point_b, lane);
  hn::Store(carriers_of(found.weights_a), d, result.carriers_a + lane);
  hn::Store(carriers_of(found.weights_b), d, result.carriers_b + lane);
}

HWY_INLINE std::uint32_t bits(Mask mask, std::size_t lane) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lanes(), mask, bytes);
  return (bytes[0] & ((1U << hn::Lanes(Lanes())) - 1U)) << lane;
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
