// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>

namespace lmdbench {

/// F = integral over t of -f'(t) times the sum, over the components of {distance <= t}, of the component's mean push. A minimum alone
/// in its component up to the cutoff has its whole force; where two components meet at a saddle they go on as one.
///
/// The mean push of a component at level t:
/// - without samples: that of its minima, -u, each by its share. At a merge the shares of either side are multiplied by that side's
///   part of the length of all branches, so a minimum vanishes where it dies and the order of merges does not matter;
/// - with them: over its patches of surface, each by area (t - its distance), and over the minima, together by
///   `minimum_area` times the length of all branches.
///
/// Weights are not negative, so no force ever pulls.
/// @param samples  ForceInput's, or none
Wrench integrate_levels(const ForceInput& input, std::span<const SurfaceSample> samples,
                        const ForceProfile& profile, const Vec3& reference_W);

}  // namespace lmdbench
