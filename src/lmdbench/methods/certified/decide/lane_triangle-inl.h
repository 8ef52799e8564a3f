// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Triangle pairs in lanes. Included once for every instruction set: no ordinary include guard.
#if defined(LMDBENCH_LANE_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_TRIANGLE_INL
#undef LMDBENCH_LANE_TRIANGLE_INL
#else
#define LMDBENCH_LANE_TRIANGLE_INL
#endif

#include <lmdbench/geometry/lane_vector-inl.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/methods/certified/decide/lane_block.h>

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

using kernel::LaneBlock;
using kernel::LaneCrossing;
using kernel::LaneGap;
using kernel::MAX_LANES;

using Lanes = hn::CappedTag<double, MAX_LANES>;
using Real = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
using Vector = LaneVector<Real>;

/// Margins, in COINCIDENCE_TOLERANCE of the largest coordinate, as in feature_proof.cpp.
constexpr double MARGIN = 16.0 * COINCIDENCE_TOLERANCE;
/// The scalar kernel takes edges at a smaller angle and faces with a smaller (relative) altitude.
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

HWY_INLINE void store(const Vector& point, double (&to)[3][MAX_LANES], std::size_t lane) {
  const Lanes d;
  hn::Store(point.x, d, to[0] + lane);
  hn::Store(point.y, d, to[1] + lane);
  hn::Store(point.z, d, to[2] + lane);
}

HWY_INLINE std::uint32_t bits(Mask mask, std::size_t lane) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lanes(), mask, bytes);
  return (bytes[0] & ((1U << hn::Lanes(Lanes())) - 1U)) << lane;
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
