// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Batches of triangle pairs: pairs that cross clearly. Included once for every instruction set.
#if defined(LMDBENCH_LANE_CROSSING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_CROSSING_INL
#undef LMDBENCH_LANE_CROSSING_INL
#else
#define LMDBENCH_LANE_CROSSING_INL
#endif

#include <lmdbench/methods/certified/decide/lane_triangle-inl.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

/// A triangle's plane; only for well-shaped triangles, where plain cross products keep their
/// digits.
struct Face {
  Vector origin, e1, e2, n;
  Real squared_n, inverse;  ///< |n|^2 and its inverse
  Real squared_longest, least_squared_altitude;
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
  face.squared_longest = longest;
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

/// A triangle's corners, or their numbers, in the same sense of rotation: beginning with corner 1
/// or 2 where a mask says so, else with corner 0.
template <class T>
HWY_INLINE Three<T> turned(const Three<T>& t, Mask first_is_1, Mask first_is_2) {
  Three<T> result;
  for (int k = 0; k < 3; ++k)
    result.v[k] = select(first_is_2, t.v[(k + 2) % 3], select(first_is_1, t.v[(k + 1) % 3], t.v[k]));
  return result;
}

/// Least part of a chord that clearly crossing triangles share, and least distance of its middle
/// from all borders (relative). The scalar kernel's exact predicates take the other pairs.
constexpr double LEAST_CROSSING_PART = 1e-4;
/// Squared least length of the face's longest side and of the other's cut edges, relative to how
/// far the other reaches: rounding of the middle moves it by less than LEAST_CROSSING_PART of them.
constexpr double LEAST_SQUARED_SIZE = 1e-8;
/// Squared sine of the least angle of chord and cutting edge, in the worst-shaped face: see `cut`.
constexpr double LEAST_SQUARED_FALL = 1e-6;

/// The part of a chord from `from` to `to` where a weight that is linear along it is not negative.
/// A lane remains in `clear` only where the weight falls by `least_squared_fall` or more if it is
/// cut: a chord along the edge has no clear cut.
HWY_INLINE void cut(Real from, Real to, Real least_squared_fall, Real& begin, Real& end, Mask& clear) {
  const Mask starts_out = hn::Lt(from, zero());
  const Mask ends_out = hn::Lt(to, zero());
  const Real fall = hn::Sub(from, to);
  const Real part = hn::Div(from, select(hn::Eq(fall, zero()), constant(1.0), fall));
  begin = hn::Max(begin, select(starts_out, part, zero()));
  end = hn::Min(end, select(ends_out, part, constant(1.0)));
  clear = hn::AndNot(hn::And(starts_out, ends_out), clear);
  clear = hn::AndNot(hn::And(hn::Or(starts_out, ends_out), hn::Lt(squared(fall), least_squared_fall)), clear);
}

/// Lanes where the triangles cross clearly, the middle of the shared segment inside both. The
/// segment is the chord that the plane of a cuts out of b, cut by the edges of a.
inline std::uint32_t crossing(const LaneBlock& block, LaneCrossing& result) {
  const Real one = constant(1.0);
  std::uint32_t done = 0;
  for (std::size_t lane = 0; lane < MAX_LANES; lane += hn::Lanes(Lanes())) {
    const Three<Vector> a = load(block.a, lane);
    const Three<Vector> b = load(block.b, lane);
    const Real magnitude = largest_coordinate(a, b);
    const Real squared_margin = squared(hn::Mul(constant(MARGIN), magnitude));
    const Face face = face_of(a);
    Three<Real> height;
    Mask clear = hn::And(hn::And(hn::Ge(magnitude, constant(SMALLEST_COORDINATE)),
                                 hn::Le(magnitude, constant(LARGEST_COORDINATE))),
                         face.well_shaped);
    const Real squared_height_margin = hn::Mul(squared_margin, face.squared_n);
    Real squared_reach = zero();
    for (int k = 0; k < 3; ++k) {
      const Vector corner = b.v[k] - face.origin;
      squared_reach = hn::Max(squared_reach, dot(corner, corner));
      height.v[k] = dot(corner, face.n);
      clear = hn::And(clear, hn::Gt(squared(height.v[k]), squared_height_margin));
    }
    const Real least_squared_size = hn::Mul(constant(LEAST_SQUARED_SIZE), squared_reach);
    clear = hn::And(clear, hn::Ge(face.squared_longest, least_squared_size));
    // The corner that is alone on its side of the plane comes first.
    const Mask lone_is_0 = hn::Gt(hn::Mul(height.v[1], height.v[2]), zero());
    const Mask lone_is_1 = hn::AndNot(lone_is_0, hn::Gt(hn::Mul(height.v[0], height.v[2]), zero()));
    const Mask lone_is_2 = hn::Not(hn::Or(lone_is_0, lone_is_1));
    clear = hn::And(clear, hn::Or(hn::Lt(hn::Mul(height.v[0], height.v[1]), zero()),
                                  hn::Lt(hn::Mul(height.v[0], height.v[2]), zero())));
    const Three<Vector> turned_b = turned(b, lone_is_1, lone_is_2);
    const Three<Real> h = turned(height, lone_is_1, lone_is_2);
    Real part[2];
    Vector chord_end[2];
    Three<Real> on_a[2];
    for (int i = 0; i < 2; ++i) {
      const Vector edge = turned_b.v[i + 1] - turned_b.v[0];
      clear = hn::And(clear, hn::Ge(dot(edge, edge), least_squared_size));
      const Real drop = hn::Sub(h.v[0], h.v[i + 1]);
      // An edge that is nearly parallel to the plane would put the chord's end elsewhere than the
      // scalar kernel does.
      clear = hn::And(clear, hn::Gt(squared(drop), hn::Mul(constant(MIN_SQUARED_SINE),
                                                           hn::Mul(face.squared_n, dot(edge, edge)))));
      part[i] = hn::Div(h.v[0], select(hn::Eq(drop, zero()), one, drop));
      chord_end[i] = turned_b.v[0] + times(part[i], edge);
      on_a[i] = weights_on(face, chord_end[i] - face.origin);
    }
    const Vector chord = chord_end[1] - chord_end[0];
    // A weight falls along the chord by its length over the altitude, times the
    // sine of its angle to the edge.
    const Real least_squared_fall = hn::Div(hn::Mul(constant(LEAST_SQUARED_FALL), dot(chord, chord)),
                                            select(face.well_shaped, face.least_squared_altitude, one));
    Real begin = zero(), end = one;
    for (int k = 0; k < 3; ++k) cut(on_a[0].v[k], on_a[1].v[k], least_squared_fall, begin, end, clear);
    const Real middle = hn::Mul(constant(0.5), hn::Add(begin, end));
    const Real rest = hn::Sub(one, middle);
    const Vector point = chord_end[0] + times(middle, chord);
    const Three<Real> weights_a = weights_on(face, point - face.origin);
    const Real towards_1 = hn::Mul(rest, part[0]);
    const Real towards_2 = hn::Mul(middle, part[1]);
    const Three<Real> weights_b{{hn::Sub(hn::Sub(one, towards_1), towards_2), towards_1, towards_2}};
    const Real least = constant(LEAST_CROSSING_PART);
    clear = hn::And(clear, hn::Gt(hn::Sub(end, begin), least));
    clear = hn::And(clear, hn::And(hn::Gt(least_of(weights_a), least), hn::Gt(least_of(weights_b), least)));
    const Real length = hn::Mul(hn::Sub(end, begin), hn::Sqrt(dot(chord, chord)));
    clear = hn::And(clear, hn::Gt(squared(length), squared_margin));
    hn::Store(length, Lanes(), result.length + lane);
    done |= bits(clear, lane);
    store(point, result.middle, lane);
  }
  return done;
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
