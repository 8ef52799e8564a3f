// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/mesh/feature_corners.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

namespace lmdbench {

namespace {

/// A vertex pair that a local minimum touches.
struct Touch {
  std::int32_t fixed_body, vertex_moving, vertex_fixed;
  std::size_t minimum;

  auto place() const { return std::tie(fixed_body, vertex_moving, vertex_fixed); }
};

bool feature_pair_less(const Lmd& a, const Lmd& b) {
  return std::tie(a.fixed_body, a.feature_moving, a.feature_fixed) <
         std::tie(b.fixed_body, b.feature_moving, b.feature_fixed);
}

/// Equal distance and direction up to rounding of the points' coordinates and up to the tilt that the
/// first-order test lets pass on each side: faces tilted by so little count as parallel there, so they must
/// here, or one plateau would be reported corner by corner.
bool same_plane_of_contact(const Lmd& a, const Lmd& b) {
  if (a.intersecting != b.intersecting) return false;
  if (a.intersecting) return true;
  const double coordinates =
      std::max(a.point_moving.cwiseAbs().maxCoeff(), a.point_fixed.cwiseAbs().maxCoeff());
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * coordinates +
                          2.0 * PLATEAU_PIECE_TOLERANCE * (a.point_moving - b.point_moving).norm();
  if (std::abs(a.distance - b.distance) > PLATEAU_TOLERANCE * std::max(a.distance, b.distance) + rounding)
    return false;
  const Vec3 difference = (a.point_fixed - a.point_moving) - (b.point_fixed - b.point_moving);
  return difference.norm() <= PLATEAU_TOLERANCE * std::max(a.distance, b.distance) + rounding;
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

Lmd representative(std::span<const LocalMinimum> minima, std::span<const std::size_t> plateau) {
  int dimension = 0;
  for (const std::size_t i : plateau) dimension = std::max(dimension, minima[i].dimension);
  double total = 0.0;
  Vec3 centroid_moving = Vec3::Zero(), centroid_fixed = Vec3::Zero();
  for (const std::size_t i : plateau) {
    if (minima[i].dimension != dimension) continue;
    const double weight = dimension == 0 ? 1.0 : minima[i].measure;
    total += weight;
    centroid_moving += weight * minima[i].lmd.point_moving;
    centroid_fixed += weight * minima[i].lmd.point_fixed;
  }
  centroid_moving /= total;
  centroid_fixed /= total;

  const LocalMinimum* nearest = nullptr;
  double nearest_squared_distance = 0.0;
  for (const std::size_t i : plateau) {
    if (minima[i].dimension != dimension) continue;
    const double squared_distance = (minima[i].lmd.point_moving - centroid_moving).squaredNorm();
    if (nearest == nullptr || squared_distance < nearest_squared_distance) {
      nearest = &minima[i];
      nearest_squared_distance = squared_distance;
    }
  }
  Lmd lmd = nearest->lmd;
  lmd.point_moving = centroid_moving;
  lmd.point_fixed = centroid_fixed;
  if (!lmd.intersecting) {
    const Vec3 d = centroid_fixed - centroid_moving;
    lmd.distance = d.norm();
    lmd.direction = d / lmd.distance;
  }
  return lmd;
}

}  // namespace

void keep_one_a_feature_pair(std::vector<LocalMinimum>& minima) {
  std::sort(minima.begin(), minima.end(), [](const LocalMinimum& a, const LocalMinimum& b) {
    if (feature_pair_less(a.lmd, b.lmd) || feature_pair_less(b.lmd, a.lmd))
      return feature_pair_less(a.lmd, b.lmd);
    if (a.lmd.distance != b.lmd.distance) return a.lmd.distance < b.lmd.distance;
    if (a.measure != b.measure) return a.measure > b.measure;
    return std::tie(a.lmd.triangle_moving, a.lmd.triangle_fixed) <
           std::tie(b.lmd.triangle_moving, b.lmd.triangle_fixed);
  });
  // What is erased leaves its strictness to the one that stays.
  for (std::size_t i = minima.size(); i-- > 1;)
    if (same_feature_pair(minima[i - 1].lmd, minima[i].lmd)) minima[i - 1].strict |= minima[i].strict;
  minima.erase(std::unique(minima.begin(), minima.end(),
                           [](const LocalMinimum& a, const LocalMinimum& b) {
                             return same_feature_pair(a.lmd, b.lmd);
                           }),
               minima.end());
}

void merge_plateaus(const Scene& scene, std::vector<LocalMinimum>& minima, LmdSet& lmds) {
  lmds.clear();
  keep_one_a_feature_pair(minima);

  std::vector<Touch> touches;
  for (std::size_t i = 0; i < minima.size(); ++i) {
    const Lmd& lmd = minima[i].lmd;
    const FeatureCorners on_moving(scene.moving->surface(), lmd.feature_moving);
    const FeatureCorners on_fixed(scene.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface(),
                                  lmd.feature_fixed);
    // Two cells of a mesh touch when they share a corner.
    for (const std::int32_t m : on_moving.view())
      for (const std::int32_t f : on_fixed.view()) touches.push_back({lmd.fixed_body, m, f, i});
  }
  std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
    return std::tuple_cat(a.place(), std::tie(a.minimum)) < std::tuple_cat(b.place(), std::tie(b.minimum));
  });

  std::vector<std::size_t> parents(minima.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (std::size_t begin = 0; begin < touches.size();) {
    std::size_t end = begin + 1;
    while (end < touches.size() && touches[begin].place() == touches[end].place()) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        const std::size_t a = touches[i].minimum, b = touches[j].minimum;
        if (!same_plane_of_contact(minima[a].lmd, minima[b].lmd)) continue;
        const std::size_t root_a = root_of(parents, a), root_b = root_of(parents, b);
        parents[std::max(root_a, root_b)] = std::min(root_a, root_b);
      }
    }
    begin = end;
  }

  std::vector<std::size_t> order(minima.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < parents.size(); ++i) parents[i] = root_of(parents, i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parents[a] < parents[b]; });
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && parents[order[begin]] == parents[order[end]]) ++end;
    if (std::none_of(order.begin() + static_cast<std::ptrdiff_t>(begin),
                     order.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::size_t i) { return minima[i].strict; })) {
      begin = end;
      continue;
    }
    if (end - begin == 1) {
      lmds.push_back(minima[order[begin]].lmd);
    } else {
      lmds.push_back(representative(minima, std::span(order).subspan(begin, end - begin)));
    }
    begin = end;
  }
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

}  // namespace lmdbench
