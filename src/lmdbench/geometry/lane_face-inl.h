// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Planes of triangles in lanes. Included once for every instruction set.
#if defined(LMDBENCH_LANE_FACE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_FACE_INL
#undef LMDBENCH_LANE_FACE_INL
#else
#define LMDBENCH_LANE_FACE_INL
#endif

#include <lmdbench/geometry/lane_triangle-inl.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

/// A triangle's plane; only for well-shaped triangles, where plain cross products keep their digits.
struct Face {
  Vector origin, e1, e2, n;
  Real squared_n, inverse;  ///< |n|^2 and its inverse
  Real least_squared_altitude;
  Mask well_shaped;
};

HWY_INLINE Face face_of(const Three<Vector>& t) {
  const Real one = constant(1.0);
  Face face;
  face.origin = t.v[0];
  face.e1 = t.v[1] - t.v[0];
  face.e2 = t.v[2] - t.v[0];
  const Vector e3 = t.v[2] - t.v[1];
  face.n = cross(face.e1, face.e2);
  face.squared_n = dot(face.n, face.n);
  const Real longest = hn::Max(dot(face.e1, face.e1), hn::Max(dot(face.e2, face.e2), dot(e3, e3)));
  // Squared altitude on the longest edge over that edge's square.
  face.well_shaped = hn::Gt(face.squared_n, hn::Mul(constant(MIN_SQUARED_SINE), squared(longest)));
  face.inverse = hn::Div(one, select(face.well_shaped, face.squared_n, one));
  face.least_squared_altitude = hn::Mul(face.squared_n, hn::Div(one, select(face.well_shaped, longest, one)));
  return face;
}

/// Weights of the face's corners for the projection of origin + w.
HWY_INLINE Three<Real> weights_on(const Face& face, const Vector& w) {
  const Real w1 = hn::Mul(dot(cross(w, face.e2), face.n), face.inverse);
  const Real w2 = hn::Mul(dot(cross(face.e1, w), face.n), face.inverse);
  return {{hn::Sub(hn::Sub(constant(1.0), w1), w2), w1, w2}};
}

HWY_INLINE Real least_of(const Three<Real>& w) {
  return hn::Min(w.v[0], hn::Min(w.v[1], w.v[2]));
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
