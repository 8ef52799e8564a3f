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

/// A function above given samples that a hand could follow and that is not much above them: nowhere
/// below a sample, |acceleration| and speed within the limits (speed to one step's acceleration).
/// Before a jump of the samples the motion moves out ahead of time.
///
/// One pass has two steps:
///  1. Braking is limited: a "cap" hangs from every sample, the way down from rest at full braking,
///     then at full speed; at every time the highest cap counts. No cap bends down faster than -a,
///     and their maximum only adds upward kinks.
///  2. Speeding up is limited: f - a t^2/2 must be concave, so the smallest such function is the
///     upper convex hull of the points (t, f - a t^2/2), with a t^2/2 added back. It touches only
///     where the caps are smooth, and so keeps step 1's bounds.
///
/// Caps begin at rest, so one pass lies v^2/(2a) above samples that move at speed v. Therefore
/// three passes share the limits, each working on what the sum of the earlier passes lacks. This
/// remainder hardly moves where samples are smooth, and there the excess all but vanishes.
///
/// @param samples values at equal time steps
/// @param time_step seconds
std::vector<double> bounded_majorant(const std::vector<double>& samples, double time_step,
                                     const MotionLimits& limits);

}  // namespace lmdbench
