// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/carriers.h>
#include <lmdbench/geometry/types.h>

namespace lmdbench::kernel {

/// Which parts of two triangles seem to carry the nearest pair.
struct FeatureGuess {
  Carriers on_a, on_b;
  bool exists = false;  ///< False where an edge clearly pierces a face, or the processor has no vectors.
};

/// The nearest of 9 edge pairs and 6 corner-face pairs, in single precision and textbook formulas, four
/// candidates at a time. Right for nearly every pair in general position; whoever asks must prove it, because
/// rounding may decide where candidates are nearly as near, and nothing at all is promised for coordinates
/// that are not finite.
/// @param scale brings the largest coordinate near 1
FeatureGuess guess_features(const Triangle& a, const Triangle& b, double scale);

}  // namespace lmdbench::kernel
