// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <cstdint>

namespace lmdbench {

/// What the closed-form test of a feature pair says.
enum class PairVerdict : std::uint8_t {
  NO_LMD,     ///< Some condition fails by more than the margin.
  LMD,        ///< Every condition holds by more than the margin: any incident triangle pair gives the LMD.
  BORDERLINE  ///< Some condition is within the margin (ties, parallel features): all incident triangle pairs
              ///< decide.
};

/// Quantities that a query fixes.
struct PairFilter {
  const Surface& moving;
  const RigidTransform& X_WM;
  const Surface& fixed;
  double cutoff;  ///< metres
  double touch;   ///< metres; pairs nearer than half of it are not this filter's: see Certified
  double margin;  ///< Relative to the lengths compared, or a sine. Far above rounding, far below geometry.
  double tiny;    ///< metres; a feature shorter than this is rounding in its size and always borderline

  /// Decides by the one candidate point pair that the two features have: two vertices; a vertex and its
  /// projection on an edge or face; the feet of the common perpendicular of two edges. The conditions are
  /// those of the ground truth's first-order test (first_order.h) with `margin` in place of its tolerance:
  /// feet inside their features, distance within the cutoff, direction in both polar cones (the outer side,
  /// which the caps of the hierarchy have settled for nearly all, is left to the final test). Edges that are
  /// parallel to an edge or a face within 1e-4, and faces that are parallel, have no single candidate and are
  /// borderline where they can be near.
  PairVerdict operator()(const FeatureId& on_moving, const FeatureId& on_fixed) const;
};

}  // namespace lmdbench
