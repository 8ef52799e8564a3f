// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/laws/level_integral.h>

namespace lmdbench {

const Aggregation& shared_law() {
  static const Aggregation law{
      .name = "shared",
      .summary = "LMDs that a saddle joins below the cutoff share one force: continuous, never pulls",
      .needs = AggregationNeeds::MERGES,
      .combine = [](const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W) {
        return integrate_levels(input, {}, profile, reference_W);
      }};
  return law;
}

}  // namespace lmdbench
