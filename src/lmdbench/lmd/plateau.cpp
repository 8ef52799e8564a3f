// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/flat_pieces.h>
#include <lmdbench/lmd/minimiser_set.h>
#include <lmdbench/lmd/nearer_piece.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/mesh/flat_regions.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace lmdbench {

namespace {

/// A vertex pair of the triangles that a minimum's set lies on.
struct Touch {
  std::int32_t fixed_body, vertex_moving, vertex_fixed;
  std::size_t minimum;

  auto operator<=>(const Touch&) const = default;
  bool is_where(const Touch& other) const {
    return fixed_body == other.fixed_body && vertex_moving == other.vertex_moving &&
           vertex_fixed == other.vertex_fixed;
  }
};

bool feature_pair_less(const Lmd& a, const Lmd& b) {
  return std::tie(a.fixed_body, a.feature_moving, a.feature_fixed) <
         std::tie(b.fixed_body, b.feature_moving, b.feature_fixed);
}

/// Equal distance and direction up to rounding of the points' coordinates and up to the tilt at which features still count as
/// parallel: or one plateau would be reported corner by corner.
/// @param tolerance of rounded meshes [m]
bool same_plane_of_contact(const Lmd& a, const Lmd& b, double tolerance) {
  const double coordinates =
      std::max(a.point_moving.cwiseAbs().maxCoeff(), a.point_fixed.cwiseAbs().maxCoeff());
  const double rounding = tolerance + 64.0 * std::numeric_limits<double>::epsilon() * coordinates +
                          PARALLEL_TILT * (a.point_moving - b.point_moving).norm();
  if (std::abs(a.distance - b.distance) > PLATEAU_TOLERANCE * std::max(a.distance, b.distance) + rounding)
    return false;
  const Vec3 difference = (a.point_fixed - a.point_moving) - (b.point_fixed - b.point_moving);
  return difference.norm() <= PARALLEL_TILT * std::max(a.distance, b.distance) + rounding;
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// Which minima may have others in their plane of contact, by their distances alone: next to none, but in flat contact.
/// @param tolerances of each fixed body [m]
std::vector<bool> have_company(std::span<const LocalMinimum> minima, std::span<const double> tolerances) {
  double coordinates = 0.0;
  for (const LocalMinimum& minimum : minima)
    coordinates = std::max({coordinates, minimum.lmd.point_moving.cwiseAbs().maxCoeff(),
                            minimum.lmd.point_fixed.cwiseAbs().maxCoeff()});
  std::vector<std::size_t> order(minima.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::pair(minima[i].lmd.fixed_body, minima[i].lmd.distance); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<bool> result(minima.size(), false);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Lmd &a = minima[order[k - 1]].lmd, &b = minima[order[k]].lmd;
    // At least what same_plane_of_contact grants.
    const double granted = tolerances[static_cast<std::size_t>(b.fixed_body)] +
                           PLATEAU_TOLERANCE * b.distance + PLATEAU_SLOPE * coordinates;
    if (a.fixed_body == b.fixed_body && b.distance - a.distance <= granted)
      result[order[k - 1]] = result[order[k]] = true;
  }
  return result;
}

/// Joins minima of one connected set of minimisers: of equal distance and direction, with sets that touch.
/// @param parents #minima; of a union-find forest
void join_connected(const Scene& scene, const RigidTransform& X_WM, std::span<const LocalMinimum> minima,
                    std::vector<std::size_t>& parents) {
  std::vector<double> tolerances;
  for (const auto& body : scene.fixed)
    tolerances.push_back(parallel_tolerance(scene.moving->surface(), body->surface()));
  const std::vector<bool> has_company = have_company(minima, tolerances);
  std::vector<std::optional<MinimiserSet>> sets(minima.size());
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < minima.size(); ++i) {
    if (!has_company[i]) continue;
    const Lmd& lmd = minima[i].lmd;
    sets[i].emplace(scene, X_WM, lmd, tolerances[static_cast<std::size_t>(lmd.fixed_body)]);
    sets[i]->for_each_corner_pair([&](std::int32_t m, std::int32_t f) {
      touches.push_back({lmd.fixed_body, m, f, i});
    });
  }
  std::sort(touches.begin(), touches.end());
  touches.erase(std::unique(touches.begin(), touches.end()), touches.end());
  for (std::size_t begin = 0; begin < touches.size();) {
    std::size_t end = begin + 1;
    while (end < touches.size() && touches[begin].is_where(touches[end])) ++end;
    const double tolerance = tolerances[static_cast<std::size_t>(touches[begin].fixed_body)];
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        const std::size_t a = touches[i].minimum, b = touches[j].minimum;
        const std::size_t root_a = root_of(parents, a), root_b = root_of(parents, b);
        if (root_a == root_b || !same_plane_of_contact(minima[a].lmd, minima[b].lmd, tolerance) ||
            !sets[a]->touches(*sets[b]))
          continue;
        parents[std::max(root_a, root_b)] = std::min(root_a, root_b);
      }
    }
    begin = end;
  }
}

/// The face or edge that names a point of a flat feature, and a triangle with it.
std::pair<FeatureId, std::int32_t> name_at(const Body& body, const FeatureId& flat, const Vec3& p_S) {
  const Surface& surface = body.surface();
  const FlatRegions& regions = body.prepared<FlatRegions>();
  if (flat.kind == FeatureKind::FACE) {
    const std::int32_t face = regions.face_at(surface, flat.index, p_S);
    return {{FeatureKind::FACE, face}, face};
  }
  const std::int32_t edge = regions.edge_at(surface, flat.index, p_S);
  return {{FeatureKind::EDGE, edge}, surface.adjacency.edge_triangles[edge].front()};
}

/// Gives a plateau's representative the name that merge_plateaus promises.
void name_plateau(const Scene& scene, const RigidTransform& X_WM, std::span<const LocalMinimum> minima,
                  std::span<const std::size_t> plateau, int dimension, Lmd& lmd) {
  const Body& moving = *scene.moving;
  const Body& fixed = *scene.fixed[static_cast<std::size_t>(lmd.fixed_body)];
  std::optional<std::pair<FeatureId, FeatureId>> first;
  for (const std::size_t i : plateau) {
    if (minima[i].dimension != dimension) continue;
    const auto pair = std::pair(
        moving.prepared<FlatRegions>().flat_feature_of(moving.surface(), minima[i].lmd.feature_moving),
        fixed.prepared<FlatRegions>().flat_feature_of(fixed.surface(), minima[i].lmd.feature_fixed));
    // A triangle without area is on no flat feature.
    if (pair.first.index < 0 || pair.second.index < 0) continue;
    if (!first || pair < *first) first = pair;
  }
  if (!first) return;
  const Vec3 p_M = X_WM.rotation.transpose() * (lmd.point_moving - X_WM.translation);
  std::tie(lmd.feature_moving, lmd.triangle_moving) = name_at(moving, first->first, p_M);
  std::tie(lmd.feature_fixed, lmd.triangle_fixed) = name_at(fixed, first->second, lmd.point_fixed);
}

Lmd representative(const Scene& scene, const RigidTransform& X_WM, std::span<const LocalMinimum> minima,
                   std::span<const std::size_t> plateau) {
  if (plateau.size() == 1) {
    const LocalMinimum& only = minima[plateau.front()];
    Lmd lmd = only.lmd;
    if (only.dimension > 0) name_plateau(scene, X_WM, minima, plateau, only.dimension, lmd);
    return lmd;
  }
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
  double nearest_distance = 0.0;
  for (const std::size_t i : plateau) {
    if (minima[i].dimension != dimension) continue;
    const double own = (minima[i].lmd.point_moving - centroid_moving).norm();
    if (nearest == nullptr || is_nearer_piece(own, nearest_distance, centroid_moving)) {
      nearest = &minima[i];
      nearest_distance = own;
    }
  }
  Lmd lmd = nearest->lmd;
  lmd.point_moving = centroid_moving;
  lmd.point_fixed = centroid_fixed;
  const Vec3 d = centroid_fixed - centroid_moving;
  lmd.distance = d.norm();
  lmd.direction = d / lmd.distance;
  if (dimension > 0) name_plateau(scene, X_WM, minima, plateau, dimension, lmd);
  return lmd;
}

}  // namespace

void keep_one_a_feature_pair(std::vector<LocalMinimum>& minima) {
  std::sort(minima.begin(), minima.end(), [](const LocalMinimum& a, const LocalMinimum& b) {
    if (feature_pair_less(a.lmd, b.lmd) || feature_pair_less(b.lmd, a.lmd))
      return feature_pair_less(a.lmd, b.lmd);
    if (a.dimension != b.dimension) return a.dimension > b.dimension;
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

void merge_plateaus(const Scene& scene, const RigidTransform& X_WM, std::vector<LocalMinimum>& minima,
                    std::vector<Intersection>& intersections, LmdSet& lmds) {
  lmds.clear();
  keep_one_a_feature_pair(minima);
  for (const LocalMinimum& minimum : minima) {
    const Lmd& lmd = minimum.lmd;
    if (lmd.intersecting)
      intersections.push_back({lmd.feature_moving, lmd.feature_fixed, lmd.triangle_moving, lmd.triangle_fixed,
                               lmd.fixed_body, minimum.dimension, minimum.measure, lmd.point_moving});
  }
  append_contacts(scene, intersections, lmds);
  minima.erase(std::remove_if(minima.begin(), minima.end(),
                              [](const LocalMinimum& minimum) { return minimum.lmd.intersecting; }),
               minima.end());

  std::vector<std::size_t> parents(minima.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  join_connected(scene, X_WM, minima, parents);

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
    const std::span pieces = std::span(order).subspan(begin, end - begin);
    lmds.push_back(representative(scene, X_WM, minima, pieces));
    begin = end;
  }
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

}  // namespace lmdbench
