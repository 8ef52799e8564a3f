// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>

namespace lmdbench {

const Aggregation& sum_law() {
  static const Aggregation law{
      .name = "sum",
      .summary = "every LMD pushes (the paper's): jumps where one is born or dies",
      .needs = AggregationNeeds::MINIMA,
      .combine = [](const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W) {
        return sum_forces(minima_of(input.critical), profile, reference_W);
      }};
  return law;
}

}  // namespace lmdbench
