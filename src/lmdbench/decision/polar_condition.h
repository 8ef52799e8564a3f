// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>

#include <optional>

namespace lmdbench {

/// How far a direction may leave a polar cone, for a wing w: u . w <= length + sine |w|.
struct PolarSlack {
  double length = 0.0;  ///< metres
  double sine = 0.0;
};

/// Whether a direction in the mesh's frame leaves a feature on its outer side, where it has one.
bool is_outer(const Surface& surface, const FeatureId& feature, const Vec3& u_S);

/// Whether a direction lies in the outward polar cone of a corner or chain: no wing rises along it,
/// and it is on the outer side where the feature has one.
/// @param feature  its index counts corners or chains
/// @param u_W  unit length, from the feature to the other mesh; square to a chain up to rounding
bool admits(const ShapeSide& side, const FeatureId& feature, const Vec3& u_W, const PolarSlack& slack);

/// A unit vector, and the sine of the angle by which rounding may have turned it.
struct KnownDirection {
  Vec3 u;
  double error;
  bool is_strict = false;  ///< In both cones by more than `error`.
};

/// The direction nearest to u that both features admit. Next to touch rounding turns the direction
/// between two points by more than angles between faces; each cone alone would admit another.
/// @param f, g  index counts corners or chains
/// @param error  sine of the angle by which u may be off; 1: u says nothing
/// @param rounding  of a wing along a direction that is known [m]
/// @param tilt  largest sine by which a direction may be off square to a chain
/// @return nothing if none is that near; its error is at most what both cones leave open
std::optional<KnownDirection> common_direction(const ShapeSide& moving, const FeatureId& f,
                                               const ShapeSide& fixed, const FeatureId& g, const Vec3& u_W,
                                               double error, double rounding, double tilt);

/// Whether a wing of a corner or chain leads towards the other mesh: u . w exceeds the slack.
bool leads_down(const ShapeSide& side, const FeatureId& feature, const Vec3& u_W, const PolarSlack& slack);

}  // namespace lmdbench
