// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>
#include <lmdbench/force/wrench_sum.h>

namespace lmdbench {

namespace {

/// F = - sum over critical pairs of index * f(d) * direction. At births and deaths a minimum and a
/// saddle cancel. F is a gradient, of the sum of index * (integral of f from d to the cutoff): no
/// work in a closed loop. Between walls at less than 60 degrees it may pull.
Wrench sum_of_signed_forces(const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W) {
  WrenchSum sum(reference_W);
  for (const CriticalPair& critical : input.critical) {
    const Lmd& lmd = critical.pair;
    if (!WrenchSum::acts(lmd, profile)) continue;
    sum.push(lmd, critical.index * force_magnitude(profile, lmd.distance));
    sum.stiffen(lmd.direction, lmd.direction, critical.index * force_stiffness(profile, lmd.distance));
  }
  return sum.wrench();
}

}  // namespace

const Aggregation& signed_law() {
  static const Aggregation law{
      .name = "signed",
      .summary =
          "every critical pair by its index: continuous, no work in a closed loop; may pull in sharp notches",
      .needs = AggregationNeeds::CRITICAL_PAIRS,
      .combine = sum_of_signed_forces};
  return law;
}

}  // namespace lmdbench
