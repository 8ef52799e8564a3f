// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace lmdbench {

/// Limits of a motion along one coordinate.
struct MotionLimits {
  double speed = 0.0;         ///< > 0 [m/s]
  double acceleration = 0.0;  ///< > 0 [m/s^2]
};

/// A function above given samples that a hand could follow and that is not much above them: nowhere below a
/// sample, |acceleration| within the limit, speed within the limit (by at most one step's acceleration).
/// Jumps of the samples are met by moving out ahead of time.
///
/// One pass has two steps:
///  1. Braking is limited: at every time the highest of the "caps" hung from the samples, a cap being the way
///     down from rest at full braking, then at full speed. No cap bends down faster than -a, and their
///     maximum only adds upward kinks.
///  2. Speeding up is limited: f - a t^2/2 must be concave, so the smallest such function is the upper convex
///     hull of the points (t, f - a t^2/2), with a t^2/2 added back. It touches only where the caps are
///     smooth, and so keeps step 1's bounds.
///
/// Caps begin at rest, so one pass lies v^2/(2a) above samples that move at speed v. Therefore the limits are
/// shared among three passes, each working on what the samples lack to the sum of the passes before it: that
/// remainder hardly moves where the samples are smooth, and there the excess all but vanishes.
///
/// Time: quadratic in the number of samples at worst.
/// @param samples values at equal time steps
/// @param time_step seconds
std::vector<double> bounded_majorant(const std::vector<double>& samples, double time_step,
                                     const MotionLimits& limits);

}  // namespace lmdbench
