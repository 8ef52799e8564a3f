// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/laws/level_integral.h>

namespace lmdbench {

/// As `shared`, but a component pushes in the mean direction of its surface. That has a limit where
/// a contact conforms (a rod in a bore); the direction of critical points has none.
const Aggregation& layered_law() {
  static const Aggregation law{
      .name = "layered",
      .summary = "as shared, in the mean direction of the surface within reach: for conforming contact; slow",
      .needs = AggregationNeeds::SURFACE,
      .combine = [](const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W) {
        return integrate_levels(input, input.samples, profile, reference_W);
      }};
  return law;
}

}  // namespace lmdbench
