// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <array>

namespace lmdbench::kernel {

/// The corners whose hull carries the current point of one triangle: a corner, an edge or the face.
struct Carriers {
  std::array<int, 3> corner{};
  int count = 0;

  static constexpr Carriers one(int k) { return {{k, 0, 0}, 1}; }
  static constexpr Carriers two(int k, int l) { return {{k, l, 0}, 2}; }
  static constexpr Carriers all() { return {{0, 1, 2}, 3}; }

  void add(int k) { corner[count++] = k; }
  void keep_only(int k) {
    corner[0] = k;
    count = 1;
  }

  TriangleFeature feature() const {
    switch (count) {
      case 1:
        return vertex_feature(corner[0]);
      case 2:
        return edge_feature((4 - corner[0] - corner[1]) % 3);
      default:
        return TriangleFeature::FACE;
    }
  }
};

/// The features of two triangles that seem to carry the nearest pair.
struct FeatureGuess {
  Carriers on_a, on_b;
  bool exists = false;  ///< False: an edge clearly pierces a face, or the CPU has no vectors.
};

/// The nearest of 9 edge pairs and 6 corner-face pairs, by textbook formulas in single precision,
/// four candidates at a time. Right for nearly every pair in general position. The caller must
/// prove it: rounding may decide between candidates that are nearly as near, and nothing is
/// promised for coordinates that are not finite.
/// @param scale brings the largest coordinate near 1
FeatureGuess guess_features(const Triangle& a, const Triangle& b, double scale);

/// Nearest pair of two triangles where it is unique by a clear margin: found from a guess of its
/// features, proved by the signs of a few dot products, and bit for bit the result of
/// distance_by_all_candidates.
/// @param tolerance coincidence_length of the largest coordinate, in [2^-100, 2^100] or not finite
/// @returns false, with `result` untouched, where it proves nothing: contact, parallel features,
///   exact ties, degenerate triangles, coordinates that are not finite
bool prove_by_features(const Triangle& a, const Triangle& b, double tolerance, TrianglePairDistance& result);

/// triangle_distance by all pairs of features: for every finite input, six times slower than
/// prove_by_features.
/// @param tolerance coincidence_length of the largest coordinate, which is 0 or in [2^-100, 2^100]
TrianglePairDistance distance_by_all_candidates(const Triangle& a, const Triangle& b, double tolerance);

}  // namespace lmdbench::kernel
