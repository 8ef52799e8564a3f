// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/match.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

namespace lmdbench::micro {
namespace {

double ratio(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

auto feature_key(const Lmd& lmd) {
  return std::tie(lmd.fixed_body, lmd.feature_moving, lmd.feature_fixed);
}

LmdSet distinct_pairs(LmdSet lmds) {
  std::sort(lmds.begin(), lmds.end(),
            [](const Lmd& a, const Lmd& b) { return feature_key(a) < feature_key(b); });
  lmds.erase(std::unique(lmds.begin(), lmds.end(), same_feature_pair), lmds.end());
  return lmds;
}

bool share_triangle(const Surface& surface, const FeatureId& a, const FeatureId& b) {
  const auto around_a = surface.incident_triangles(a);
  const auto around_b = surface.incident_triangles(b);
  return std::any_of(around_a.begin(), around_a.end(), [&](std::int32_t triangle) {
    return std::find(around_b.begin(), around_b.end(), triangle) != around_b.end();
  });
}

bool matches(const Lmd& a, const Lmd& b, Match match, const Scene& scene) {
  if (match == Match::FEATURE_PAIR) return same_feature_pair(a, b);
  if (a.fixed_body != b.fixed_body) return false;
  const Surface& fixed = scene.fixed.at(static_cast<std::size_t>(a.fixed_body))->surface();
  return share_triangle(scene.moving->surface(), a.feature_moving, b.feature_moving) &&
         share_triangle(fixed, a.feature_fixed, b.feature_fixed);
}

std::size_t count_matched(const LmdSet& some, const LmdSet& others, Match match, const Scene& scene) {
  return static_cast<std::size_t>(std::count_if(some.begin(), some.end(), [&](const Lmd& lmd) {
    return std::any_of(others.begin(), others.end(),
                       [&](const Lmd& other) { return matches(lmd, other, match, scene); });
  }));
}

}  // namespace

double MatchCount::recall() const {
  return ratio(found, truths);
}
double MatchCount::precision() const {
  return ratio(right, reported);
}

MatchCount& MatchCount::operator+=(const MatchCount& other) {
  truths += other.truths;
  found += other.found;
  reported += other.reported;
  right += other.right;
  return *this;
}

MatchCount count_matches(const LmdSet& truth, const LmdSet& reported, Match match, const Scene& scene) {
  const LmdSet distinct = distinct_pairs(reported);
  return {truth.size(), count_matched(truth, distinct, match, scene), distinct.size(),
          count_matched(distinct, truth, match, scene)};
}

}  // namespace lmdbench::micro
