// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/lmd.h>

#include <tuple>
#include <utility>

namespace lmdbench {

bool lmd_less(const Lmd& a, const Lmd& b) {
  return std::tie(a.distance, a.fixed_body, a.feature_moving, a.feature_fixed, a.triangle_moving,
                  a.triangle_fixed) < std::tie(b.distance, b.fixed_body, b.feature_moving, b.feature_fixed,
                                               b.triangle_moving, b.triangle_fixed);
}

Lmd turned_round(const Lmd& lmd) {
  Lmd turned = lmd;
  std::swap(turned.point_moving, turned.point_fixed);
  std::swap(turned.feature_moving, turned.feature_fixed);
  std::swap(turned.triangle_moving, turned.triangle_fixed);
  turned.direction = -lmd.direction;
  return turned;
}

bool same_feature_pair(const Lmd& a, const Lmd& b) {
  return a.fixed_body == b.fixed_body && a.feature_moving == b.feature_moving &&
         a.feature_fixed == b.feature_fixed;
}

double minimum_distance(const LmdSet& lmds) {
  LMDBENCH_EXPECTS(std::ranges::none_of(lmds, [](const Lmd& lmd) { return lmd.distance < 0.0; }),
                   "a signed gap in place of a distance");
  double minimum = std::numeric_limits<double>::quiet_NaN();
  for (const Lmd& lmd : lmds)
    if (!(lmd.distance >= minimum)) minimum = lmd.distance;
  return minimum;
}

}  // namespace lmdbench
