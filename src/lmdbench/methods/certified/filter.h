// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/shape_complex.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/coherence/certificate.h>

#include <cstdint>

namespace lmdbench {

/// What the closed-form test of a feature pair says.
enum class PairVerdict : std::uint8_t {
  NO_LMD,  ///< Some condition fails by more than the margin.
  ASK      ///< The definition has to be asked.
};

/// What a test answers, and what that stands.
struct PairAnswer {
  PairVerdict verdict = PairVerdict::ASK;
  Certificate certificate;  ///< Of NO_LMD.
};

/// Quantities that a query fixes.
struct PairFilter {
  const Surface& moving;
  const RigidTransform& X_WM;
  const Surface& fixed;
  double reach;     ///< metres; ContactTolerance::reach
  double rounding;  ///< metres; ContactTolerance::rounding
  double touch;     ///< metres; pairs nearer than half of it are not this filter's:
                    ///< see TouchingPairs
  double margin;    ///< Relative to the lengths compared, or a sine. Far above
                    ///< rounding, far below geometry.
  double tiny;      ///< metres; a feature shorter than this is rounding in its size
                    ///< and always left to the definition
  const ShapeComplex& shape_moving;
  const ShapeComplex& shape_fixed;
  /// Rejects (PROOF.md, lemma 9) by the one candidate point pair that two features have: two corners; a corner and its projection on a chain or
  /// region; the feet of the common perpendicular of two chains. The conditions are those of the definition (lmd/decide.h) with
  /// `margin` in place of its rounding: feet inside their features, distance within the cutoff, direction in both polar cones
  /// (the outer side, which the caps of the hierarchy have settled for nearly all, is left to the definition). Chains that are
  /// parallel to a chain or a region within 1e-4, and regions that are parallel, have no single candidate and are left to the
  /// definition where they can be near.
  ///
  /// How long the rejection stands follows from what rejected the pair (PROOF.md, lemmas 19 and 20):
  /// - too far, or on the inner side of a face: distances of points, lines and planes are convex in a
  ///   displacement, and their gradient is the unit vector between the nearest points;
  /// - a foot beyond an end or side by h: the distance from the plane through the end or side, square to the
  ///   edge or face, is linear. Two edges at the angle alpha: the plane through one edge and the common
  ///   perpendicular n also turns, by no more than n; n turns by phi <= (pi / 3) theta / sin(alpha) while
  ///   theta <= sin(alpha) / 2, which is a lever arm of its own, and phi |Delta| is a spread;
  /// - d leaves a cone by d . e > 0 for a unit e: linear where d is the difference of two points, or of
  ///   a point and its foot on an edge; where d is along a face's normal or n, it changes by |d| times
  ///   the angle.
  ///
  /// @param lever_arm of the moving feature: its radius about its centre and two cutoffs [m]
  PairAnswer operator()(const FeatureId& on_moving, const FeatureId& on_fixed, double lever_arm) const;
};

}  // namespace lmdbench
