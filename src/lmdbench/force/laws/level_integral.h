// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>

namespace lmdbench {

/// F = integral over t of -f'(t) times the sum, over components of {distance <= t}, of their mean
/// pushes. A minimum alone in its component up to the cutoff has its whole force; two components
/// that meet at a saddle go on as one.
///
/// The mean push of a component at level t:
/// - without samples: of its minima, -u each, by shares. A merge multiplies a side's shares by its
///   part of all branches' length: a minimum vanishes where it dies, in any order of merges;
/// - with samples: of its patches of surface, each by area (t - its distance), and of its minima,
///   all together by its area (`minimum_areas`) times the length of all branches.
/// Weights are not negative, so no force ever pulls.
/// @param samples  ForceInput's, or none
Wrench integrate_levels(const ForceInput& input, std::span<const SurfaceSample> samples,
                        const ForceProfile& profile, const Vec3& reference_W);

}  // namespace lmdbench
