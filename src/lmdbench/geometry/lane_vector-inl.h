// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors of R^3 in lanes. Included once for every instruction set: no ordinary include guard.
#if defined(LMDBENCH_LANE_VECTOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_VECTOR_INL
#undef LMDBENCH_LANE_VECTOR_INL
#else
#define LMDBENCH_LANE_VECTOR_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One vector of R^3 a lane; `Real` is a register of numbers.
template <class Real>
struct LaneVector {
  Real x, y, z;
};

template <class Real>
HWY_INLINE LaneVector<Real> operator-(const LaneVector<Real>& a, const LaneVector<Real>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class Real>
HWY_INLINE LaneVector<Real> operator+(const LaneVector<Real>& a, const LaneVector<Real>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class Real>
HWY_INLINE LaneVector<Real> times(Real s, const LaneVector<Real>& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
template <class Real>
HWY_INLINE Real dot(const LaneVector<Real>& a, const LaneVector<Real>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class Real>
HWY_INLINE LaneVector<Real> cross(const LaneVector<Real>& a, const LaneVector<Real>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
template <class Mask, class Real>
HWY_INLINE LaneVector<Real> select(Mask mask, const LaneVector<Real>& yes, const LaneVector<Real>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
