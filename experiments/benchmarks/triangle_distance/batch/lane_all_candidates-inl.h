// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Stage of triangle_distance_batch: nine edge pairs and six corners over faces. Included
// once for every instruction set.
#if defined(LMDBENCH_LANE_ALL_CANDIDATES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_LANE_ALL_CANDIDATES_INL
#undef LMDBENCH_LANE_ALL_CANDIDATES_INL
#else
#define LMDBENCH_LANE_ALL_CANDIDATES_INL
#endif

#include <lmdbench/geometry/lane_face-inl.h>
#include <lmdbench/geometry/lane_triangle-inl.h>

#include <benchmarks/triangle_distance/batch/lane_segments-inl.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

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

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
