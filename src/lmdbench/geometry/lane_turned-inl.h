// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Triangles turned to start at a corner that differs by lane. Included once for every instruction set.
#if defined(LMDBENCH_LANE_TURNED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_TURNED_INL
#undef LMDBENCH_LANE_TURNED_INL
#else
#define LMDBENCH_LANE_TURNED_INL
#endif

#include <lmdbench/geometry/lane_triangle-inl.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

/// A triangle seen from its start corner, in the same sense of rotation.
struct Turned {
  Three<Vector> corner;
  Mask first_is_1, first_is_2;
};

/// Starts with corner 1 or 2 where a mask says so, else with corner 0.
HWY_INLINE Turned turned(const Three<Vector>& t, Mask first_is_1, Mask first_is_2) {
  Turned result;
  result.first_is_1 = first_is_1;
  result.first_is_2 = first_is_2;
  for (int k = 0; k < 3; ++k) {
    result.corner.v[k] =
        select(result.first_is_2, t.v[(k + 2) % 3], select(result.first_is_1, t.v[(k + 1) % 3], t.v[k]));
  }
  return result;
}

/// Weights in the order of the turned triangle, back in the caller's order.
HWY_INLINE Three<Real> turned_back(const Turned& turn, const Three<Real>& w) {
  Three<Real> result;
  for (int k = 0; k < 3; ++k) {
    result.v[k] =
        select(turn.first_is_2, w.v[(k + 1) % 3], select(turn.first_is_1, w.v[(k + 2) % 3], w.v[k]));
  }
  return result;
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
