// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/matching.h>

#include <algorithm>
#include <cstddef>

namespace lmdbench {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(part) / static_cast<double>(whole);
}

bool share_a_triangle(const Surface& surface, const FeatureId& a, const FeatureId& b) {
  const auto triangles_of_a = surface.incident_triangles(a);
  const auto triangles_of_b = surface.incident_triangles(b);
  return std::any_of(triangles_of_a.begin(), triangles_of_a.end(), [&](std::int32_t triangle) {
    return std::find(triangles_of_b.begin(), triangles_of_b.end(), triangle) != triangles_of_b.end();
  });
}

}  // namespace

SetAgreement strict_agreement(const LmdSet& set, const LmdSet& truth) {
  std::vector<bool> used(set.size(), false);
  std::size_t matched = 0;
  for (const Lmd& true_lmd : truth) {
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (used[i] || !same_feature_pair(set[i], true_lmd)) continue;
      used[i] = true;
      ++matched;
      break;
    }
  }
  return {share(matched, truth.size()), share(matched, set.size())};
}

SetAgreement adjacent_agreement(const LmdSet& set, const LmdSet& truth, const Surface& moving,
                                const std::vector<const Surface*>& fixed) {
  const auto adjacent = [&](const Lmd& a, const Lmd& b) {
    return a.fixed_body == b.fixed_body && share_a_triangle(moving, a.feature_moving, b.feature_moving) &&
           share_a_triangle(*fixed[static_cast<std::size_t>(a.fixed_body)], a.feature_fixed, b.feature_fixed);
  };
  const auto count_with_partner = [&](const LmdSet& these, const LmdSet& those) {
    return static_cast<std::size_t>(std::count_if(these.begin(), these.end(), [&](const Lmd& lmd) {
      return std::any_of(those.begin(), those.end(), [&](const Lmd& other) { return adjacent(lmd, other); });
    }));
  };
  return {share(count_with_partner(truth, set), truth.size()),
          share(count_with_partner(set, truth), set.size())};
}

}  // namespace lmdbench
