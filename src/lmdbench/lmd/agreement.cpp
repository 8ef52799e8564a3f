// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/agreement.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

namespace lmdbench {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(part) / static_cast<double>(whole);
}

auto feature_key(const Lmd& lmd) {
  return std::tie(lmd.fixed_body, lmd.feature_moving, lmd.feature_fixed);
}

bool share_a_triangle(const Surface& surface, const FeatureId& a, const FeatureId& b) {
  const auto triangles_of_a = surface.incident_triangles(a);
  const auto triangles_of_b = surface.incident_triangles(b);
  return std::any_of(triangles_of_a.begin(), triangles_of_a.end(),
                     [&](std::int32_t triangle) { return triangles_of_b.contains(triangle); });
}

bool neighbours(const Lmd& a, const Lmd& b, const Scene& scene) {
  if (a.fixed_body != b.fixed_body) return false;
  const ObjectPair pair = ObjectPair::of(a.fixed_body, scene);
  LMDBENCH_EXPECTS(a.fixed_body >= 0 && pair.other < scene.object_count(), "a set of another scene");
  return share_a_triangle(scene.body(pair.mover)->surface(), a.feature_moving, b.feature_moving) &&
         share_a_triangle(scene.body(pair.other)->surface(), a.feature_fixed, b.feature_fixed);
}

std::size_t count_same(const LmdSet& truth, const LmdSet& reported) {
  std::vector<bool> used(reported.size(), false);
  std::size_t matched = 0;
  for (const Lmd& true_lmd : truth) {
    for (std::size_t i = 0; i < reported.size(); ++i) {
      if (used[i] || !same_feature_pair(reported[i], true_lmd)) continue;
      used[i] = true;
      ++matched;
      break;
    }
  }
  return matched;
}

std::size_t count_with_neighbour(const LmdSet& these, const LmdSet& those, const Scene& scene) {
  return static_cast<std::size_t>(std::count_if(these.begin(), these.end(), [&](const Lmd& lmd) {
    return std::any_of(those.begin(), those.end(),
                       [&](const Lmd& other) { return neighbours(lmd, other, scene); });
  }));
}

}  // namespace

double Agreement::recall() const {
  LMDBENCH_EXPECTS(found <= true_lmds, "one LMD counted for two true ones");
  return share(found, true_lmds);
}

double Agreement::precision() const {
  LMDBENCH_EXPECTS(right <= reported, "one true LMD counted for two reported ones");
  return share(right, reported);
}

Agreement& Agreement::operator+=(const Agreement& other) {
  true_lmds += other.true_lmds;
  found += other.found;
  reported += other.reported;
  right += other.right;
  return *this;
}

Agreement agreement(const LmdSet& truth, const LmdSet& reported, Match match, const Scene& scene) {
  if (match == Match::SAME_FEATURES) {
    const std::size_t matched = count_same(truth, reported);
    return {truth.size(), matched, reported.size(), matched};
  }
  return {truth.size(), count_with_neighbour(truth, reported, scene), reported.size(),
          count_with_neighbour(reported, truth, scene)};
}

LmdSet distinct_pairs(LmdSet lmds) {
  std::sort(lmds.begin(), lmds.end(),
            [](const Lmd& a, const Lmd& b) { return feature_key(a) < feature_key(b); });
  lmds.erase(std::unique(lmds.begin(), lmds.end(), same_feature_pair), lmds.end());
  return lmds;
}

}  // namespace lmdbench
