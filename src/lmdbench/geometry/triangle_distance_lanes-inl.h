// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Vector stages of triangle_distance_batch. Included once for every instruction set, hence no ordinary
// include guard.
#if defined(LMDBENCH_TRIANGLE_DISTANCE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_TRIANGLE_DISTANCE_LANES_INL
#undef LMDBENCH_TRIANGLE_DISTANCE_LANES_INL
#else
#define LMDBENCH_TRIANGLE_DISTANCE_LANES_INL
#endif

#include <lmdbench/geometry/lane_block.h>
#include <lmdbench/geometry/tolerance.h>

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using kernel::LaneBlock;
using kernel::LaneResult;
using kernel::MAX_LANES;

using Lanes = hn::CappedTag<double, MAX_LANES>;
using Real = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;

/// Margins are this many COINCIDENCE_TOLERANCE of the largest coordinate wide, as in feature_descent.
constexpr double MARGIN = 16.0 * COINCIDENCE_TOLERANCE;
/// Edges at a smaller angle and faces with a smaller altitude (relative, squared) are left to the scalar
/// kernel: from here on the points of both kernels agree to 1e-12.
constexpr double MIN_SQUARED_SINE = 1e-4;
/// Crossing triangles share at least this part of a chord, and its middle is at least this part away from all
/// borders; the rest is left to the scalar kernel's exact predicates.
constexpr double LEAST_CROSSING_PART = 1e-4;
/// Squared sine of the angle between the chord and an edge that cuts it, in the worst-shaped face: see `cut`.
constexpr double LEAST_SQUARED_FALL = 1e-6;
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

struct Vector {
  Real x, y, z;
};

HWY_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vector times(Real s, const Vector& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE Real dot(const Vector& a, const Vector& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Vector select(Mask mask, const Vector& yes, const Vector& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
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

/// The corner is behind the plane through p across d by the margin.
HWY_INLINE Mask is_behind(const Vector& way, const Vector& d, Real squared_d, Real squared_margin) {
  const Real ahead = dot(way, d);
  return hn::And(hn::Lt(ahead, zero()),
                 hn::Gt(squared(ahead), hn::Mul(squared_margin, hn::Add(dot(way, way), squared_d))));
}

/// Lanes where the found pair is proved to be the one nearest pair.
HWY_INLINE Mask proved(const Three<Vector>& a, const Three<Vector>& b, const Found& found) {
  const Vector d = found.point_b - found.point_a;
  const Vector minus_d = found.point_a - found.point_b;
  const Real squared_d = dot(d, d);
  const Real magnitude = largest_coordinate(a, b);
  const Real squared_margin = squared(hn::Mul(constant(MARGIN), magnitude));
  Mask result = hn::And(hn::Ge(magnitude, constant(SMALLEST_COORDINATE)),
                        hn::Le(magnitude, constant(LARGEST_COORDINATE)));
  for (int k = 0; k < 3; ++k) {
    const Mask behind_a = is_behind(a.v[k] - found.point_a, d, squared_d, squared_margin);
    const Mask behind_b = is_behind(b.v[k] - found.point_b, minus_d, squared_d, squared_margin);
    result = hn::And(result, hn::Or(behind_a, hn::Gt(found.weights_a.v[k], zero())));
    result = hn::And(result, hn::Or(behind_b, hn::Gt(found.weights_b.v[k], zero())));
  }
  const Mask clear = hn::And(hn::Gt(found.squared_rise, squared_margin),
                             hn::Gt(squared(found.squared_rise), hn::Mul(squared_margin, squared_d)));
  return hn::And(result, clear);
}

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

HWY_INLINE Turned turned(const Three<Vector>& t, const Vector& direction) {
  const Real h0 = dot(t.v[0], direction), h1 = dot(t.v[1], direction), h2 = dot(t.v[2], direction);
  const Mask first_is_2 = hn::Gt(h2, hn::Max(h0, h1));
  return turned(t, hn::AndNot(first_is_2, hn::Gt(h1, h0)), first_is_2);
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

/// The edge from the first corner to the neighbour that is steepest ahead along d; none where neither is
/// ahead.
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

HWY_INLINE void store(const Found& found, std::size_t lane, LaneResult& result) {
  const Lanes d;
  hn::Store(found.point_a.x, d, result.point_a[0] + lane);
  hn::Store(found.point_a.y, d, result.point_a[1] + lane);
  hn::Store(found.point_a.z, d, result.point_a[2] + lane);
  hn::Store(found.point_b.x, d, result.point_b[0] + lane);
  hn::Store(found.point_b.y, d, result.point_b[1] + lane);
  hn::Store(found.point_b.z, d, result.point_b[2] + lane);
  for (int k = 0; k < 3; ++k) {
    hn::Store(found.weights_a.v[k], d, result.weights_a[k] + lane);
    hn::Store(found.weights_b.v[k], d, result.weights_b[k] + lane);
  }
}

HWY_INLINE std::uint32_t bits(Mask mask, std::size_t lane) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lanes(), mask, bytes);
  return (bytes[0] & ((1U << hn::Lanes(Lanes())) - 1U)) << lane;
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

/// The best candidate so far.
struct Best {
  Real squared_distance;
  Found found;
};

HWY_INLINE void keep_nearer(Best& best, Real squared_distance, const Found& candidate) {
  const Mask nearer = hn::Lt(squared_distance, best.squared_distance);
  best.squared_distance = select(nearer, squared_distance, best.squared_distance);
  best.found.squared_rise = select(nearer, candidate.squared_rise, best.found.squared_rise);
  for (int k = 0; k < 3; ++k) {
    best.found.weights_a.v[k] = select(nearer, candidate.weights_a.v[k], best.found.weights_a.v[k]);
    best.found.weights_b.v[k] = select(nearer, candidate.weights_b.v[k], best.found.weights_b.v[k]);
  }
}

HWY_INLINE Three<Real> edge_weights(int k, Real part) {
  Three<Real> weights{{zero(), zero(), zero()}};
  weights.v[k] = hn::Sub(constant(1.0), part);
  weights.v[(k + 1) % 3] = part;
  return weights;
}

HWY_INLINE Three<Real> corner_weights(int k) {
  Three<Real> weights{{zero(), zero(), zero()}};
  weights.v[k] = constant(1.0);
  return weights;
}

HWY_INLINE Vector weighted(const Three<Vector>& t, const Three<Real>& w) {
  return times(w.v[0], t.v[0]) + times(w.v[1], t.v[1]) + times(w.v[2], t.v[2]);
}

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

/// Corners of `t` over the face; `swap` says that t is the second triangle of the pair.
HWY_INLINE void examine_corners_over_face(const Three<Vector>& t, const Face& face, bool swap, Best& best) {
  for (int k = 0; k < 3; ++k) {
    const Vector w = t.v[k] - face.origin;
    const Three<Real> on_face = weights_on(face, w);
    const Real least = least_of(on_face);
    const Mask inside = hn::And(face.well_shaped, hn::Gt(least, zero()));
    const Real squared_height = hn::Mul(squared(dot(w, face.n)), face.inverse);
    Found candidate;
    candidate.weights_a = swap ? on_face : corner_weights(k);
    candidate.weights_b = swap ? corner_weights(k) : on_face;
    candidate.squared_rise = hn::Mul(squared(least), face.least_squared_altitude);
    keep_nearer(best, select(inside, squared_height, constant(HUGE_VAL)), candidate);
  }
}

std::uint32_t all_candidates(const LaneBlock& block, LaneResult& result) {
  std::uint32_t done = 0;
  for (std::size_t lane = 0; lane < MAX_LANES; lane += hn::Lanes(Lanes())) {
    const Three<Vector> a = load(block.a, lane);
    const Three<Vector> b = load(block.b, lane);
    Best best;
    best.squared_distance = constant(HUGE_VAL);
    best.found = {corner_weights(0), corner_weights(0), a.v[0], b.v[0], zero()};
    for (int i = 0; i < 3; ++i) {
      const Vector d1 = a.v[(i + 1) % 3] - a.v[i];
      for (int j = 0; j < 3; ++j) {
        const Vector d2 = b.v[(j + 1) % 3] - b.v[j];
        const Vector r = b.v[j] - a.v[i];
        const Parameters nearest = nearest_on_segments(r, d1, d2);
        const Vector d = r + times(nearest.t, d2) - times(nearest.s, d1);
        Found candidate;
        candidate.weights_a = edge_weights(i, nearest.s);
        candidate.weights_b = edge_weights(j, nearest.t);
        candidate.squared_rise = nearest.squared_rise;
        keep_nearer(best, dot(d, d), candidate);
      }
    }
    examine_corners_over_face(a, face_of(b), false, best);
    examine_corners_over_face(b, face_of(a), true, best);
    best.found.point_a = weighted(a, best.found.weights_a);
    best.found.point_b = weighted(b, best.found.weights_b);
    done |= bits(proved(a, b, best.found), lane);
    store(best.found, lane, result);
  }
  return done;
}

/// The part of a chord from `from` to `to` where a weight that is linear along it is not negative. Leaves
/// only lanes in `clear` whose weight falls by `least_squared_fall` at least where it is cut: a chord along
/// the edge has no clear cut.
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

/// Lanes where the triangles cross clearly, with the middle of the segment that they share inside both: the
/// chord that the plane of a cuts out of b, cut by the edges of a.
std::uint32_t crossing(const LaneBlock& block, LaneResult& result) {
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
    for (int k = 0; k < 3; ++k) {
      height.v[k] = dot(b.v[k] - face.origin, face.n);
      clear = hn::And(clear, hn::Gt(squared(height.v[k]), squared_height_margin));
    }
    // The corner that is alone on its side of the plane comes first.
    const Mask lone_is_0 = hn::Gt(hn::Mul(height.v[1], height.v[2]), zero());
    const Mask lone_is_1 = hn::AndNot(lone_is_0, hn::Gt(hn::Mul(height.v[0], height.v[2]), zero()));
    const Mask lone_is_2 = hn::Not(hn::Or(lone_is_0, lone_is_1));
    clear = hn::And(clear, hn::Or(hn::Lt(hn::Mul(height.v[0], height.v[1]), zero()),
                                  hn::Lt(hn::Mul(height.v[0], height.v[2]), zero())));
    const Turned turned_b = turned(b, lone_is_1, lone_is_2);
    Three<Real> h;
    for (int k = 0; k < 3; ++k) {
      h.v[k] =
          select(lone_is_2, height.v[(k + 2) % 3], select(lone_is_1, height.v[(k + 1) % 3], height.v[k]));
    }
    Real part[2];
    Vector chord_end[2];
    Three<Real> on_a[2];
    for (int i = 0; i < 2; ++i) {
      const Vector edge = turned_b.corner.v[i + 1] - turned_b.corner.v[0];
      const Real drop = hn::Sub(h.v[0], h.v[i + 1]);
      // The edge must not be nearly parallel to the plane, or the chord's end is not where the scalar kernel
      // has it.
      clear = hn::And(clear, hn::Gt(squared(drop), hn::Mul(constant(MIN_SQUARED_SINE),
                                                           hn::Mul(face.squared_n, dot(edge, edge)))));
      part[i] = hn::Div(h.v[0], select(hn::Eq(drop, zero()), one, drop));
      chord_end[i] = turned_b.corner.v[0] + times(part[i], edge);
      on_a[i] = weights_on(face, chord_end[i] - face.origin);
    }
    const Vector chord = chord_end[1] - chord_end[0];
    // A weight falls along the chord by its length over the altitude, times the sine of its angle to the
    // edge.
    const Real least_squared_fall = hn::Div(hn::Mul(constant(LEAST_SQUARED_FALL), dot(chord, chord)),
                                            select(face.well_shaped, face.least_squared_altitude, one));
    Real begin = zero(), end = one;
    for (int k = 0; k < 3; ++k) cut(on_a[0].v[k], on_a[1].v[k], least_squared_fall, begin, end, clear);
    const Real middle = hn::Mul(constant(0.5), hn::Add(begin, end));
    const Real rest = hn::Sub(one, middle);
    Found found;
    found.point_a = found.point_b = chord_end[0] + times(middle, chord);
    found.weights_a = weights_on(face, found.point_a - face.origin);
    const Real towards_1 = hn::Mul(rest, part[0]);
    const Real towards_2 = hn::Mul(middle, part[1]);
    found.weights_b =
        turned_back(turned_b, {{hn::Sub(hn::Sub(one, towards_1), towards_2), towards_1, towards_2}});
    const Real least = constant(LEAST_CROSSING_PART);
    clear = hn::And(clear, hn::Gt(hn::Sub(end, begin), least));
    clear = hn::And(
        clear, hn::And(hn::Gt(least_of(found.weights_a), least), hn::Gt(least_of(found.weights_b), least)));
    const Real length = hn::Mul(hn::Sub(end, begin), hn::Sqrt(dot(chord, chord)));
    clear = hn::And(clear, hn::Gt(squared(length), squared_margin));
    hn::Store(length, Lanes(), result.shared_length + lane);
    done |= bits(clear, lane);
    store(found, lane, result);
  }
  return done;
}

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
