// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/corner_groups.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/shape_complex.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>

namespace lmdbench {

namespace {

std::uint64_t number(const FeatureId& feature) {
  return static_cast<std::uint64_t>(feature.kind) << 32 | static_cast<std::uint32_t>(feature.index);
}

/// Whether the first of two pairs of triangles with equal features counts: it shares more, or is
/// the first by triangles, in no order of a search.
bool shares_more(const Intersection& a, const Intersection& b) {
  return std::tuple(-a.dimension, -a.measure, a.triangle_moving, a.triangle_fixed) <
         std::tuple(-b.dimension, -b.measure, b.triangle_moving, b.triangle_fixed);
}

/// Sorts by body and features, by way of short keys, and leaves one of those with equal ones.
void sort_by_features(std::vector<Intersection>& intersections) {
  struct Key {
    std::uint64_t moving, fixed;
    std::size_t index;
    bool operator<(const Key& other) const {
      return moving != other.moving ? moving < other.moving : fixed < other.fixed;
    }
    bool same_features(const Key& other) const { return moving == other.moving && fixed == other.fixed; }
  };
  std::vector<Key> keys;
  keys.reserve(intersections.size());
  for (std::size_t i = 0; i < intersections.size(); ++i) {
    const Intersection& piece = intersections[i];
    keys.push_back({static_cast<std::uint64_t>(piece.fixed_body) << 40 | number(piece.on_moving),
                    number(piece.on_fixed), i});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Intersection> sorted;
  sorted.reserve(intersections.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Intersection& piece = intersections[keys[i].index];
    if (i == 0 || !keys[i].same_features(keys[i - 1]))
      sorted.push_back(piece);
    else if (shares_more(piece, sorted.back()))
      sorted.back() = piece;
  }
  intersections.swap(sorted);
}

/// Error of a crossing point over the largest coordinate (certified/PROOF.md, lemma 11).
constexpr double CROSSING_ERROR = 1e-11;

double extent_of(const Body& body) {
  return body.prepared<ShapeComplex>().regions.extent;
}

struct CrossingContact {
  int dimension = 0;
  double measure = 0.0;  ///< Of the pieces of that dimension; of points, their number.
  Vec3 centroid = Vec3::Zero();
  double distance = std::numeric_limits<double>::infinity();  ///< Of the nearest piece.
  const Intersection* nearest = nullptr;

  double weight_of(const Intersection& piece) const { return dimension == 0 ? 1.0 : piece.measure; }
  void add(const Intersection& piece) {
    if (piece.dimension < dimension) return;
    if (piece.dimension > dimension) *this = {.dimension = piece.dimension};
    measure += weight_of(piece);
    centroid += weight_of(piece) * piece.point;
  }
  /// The piece nearest to the centroid; differences of rounding and kernels choose no other one.
  /// @param crossing_error  of a piece's point [m]
  void name(const Intersection& piece, double crossing_error) {
    constexpr double EQUALLY_NEAR = 1e-9;  // of the distance
    if (piece.dimension < dimension) return;
    const double own = (piece.point - centroid).norm();
    if (!(own < distance * (1.0 - EQUALLY_NEAR) - crossing_error)) return;
    distance = own;
    nearest = &piece;
  }
};

}  // namespace

Intersection intersection_of(const ShapePair& pair, std::int32_t triangle_moving, std::int32_t triangle_fixed,
                             std::int32_t fixed_body, const TrianglePairDistance& nearest) {
  return {pair.moving.surface.feature_of(triangle_moving, nearest.feature_a),
          pair.fixed.surface.feature_of(triangle_fixed, nearest.feature_b),
          triangle_moving,
          triangle_fixed,
          fixed_body,
          nearest.minimiser_dimension,
          nearest.minimiser_measure,
          nearest.point_a};
}

void append_contacts(const Scene& scene, std::vector<Intersection>& intersections, LmdSet& lmds) {
  if (intersections.empty()) return;
  sort_by_features(intersections);
  CornerGroups groups(intersections.size());
  const Surface& moving = scene.moving->surface();
  for (std::size_t i = 0; i < intersections.size(); ++i) {
    const Intersection& piece = intersections[i];
    if (i > 0 && piece.fixed_body != intersections[i - 1].fixed_body) groups.forget_corners();
    const Surface& fixed = scene.fixed[static_cast<std::size_t>(piece.fixed_body)]->surface();
    groups.add(i, FeatureCorners(moving, piece.on_moving).view(),
               FeatureCorners(fixed, piece.on_fixed).view());
  }
  // A group is named by its first piece, so that its contact exists before the others come.
  std::vector<std::uint32_t> contact_of(intersections.size());
  std::vector<CrossingContact> contacts;
  for (std::size_t i = 0; i < intersections.size(); ++i) {
    const std::size_t group = groups.group_of(i);
    if (group == i) {
      contact_of[i] = static_cast<std::uint32_t>(contacts.size());
      contacts.emplace_back();
    } else {
      contact_of[i] = contact_of[group];
    }
    contacts[contact_of[i]].add(intersections[i]);
  }
  for (CrossingContact& contact : contacts) contact.centroid /= contact.measure;
  LMDBENCH_ENSURES(
      std::ranges::all_of(contacts, [](const CrossingContact& c) { return c.centroid.allFinite(); }),
      "pieces without a measure");
  double crossing_error = 0.0;
  for (std::size_t i = 0; i < intersections.size(); ++i) {
    const std::int32_t body = intersections[i].fixed_body;
    if (i == 0 || body != intersections[i - 1].fixed_body)
      crossing_error = CROSSING_ERROR *
                       (extent_of(*scene.moving) + extent_of(*scene.fixed[static_cast<std::size_t>(body)]));
    contacts[contact_of[i]].name(intersections[i], crossing_error);
  }

  for (const CrossingContact& contact : contacts) {
    const Intersection& piece = *contact.nearest;
    Lmd lmd;
    lmd.distance = 0.0;
    lmd.point_moving = lmd.point_fixed = contact.centroid;
    lmd.feature_moving = piece.on_moving;
    lmd.feature_fixed = piece.on_fixed;
    lmd.triangle_moving = piece.triangle_moving;
    lmd.triangle_fixed = piece.triangle_fixed;
    lmd.fixed_body = piece.fixed_body;
    lmd.intersecting = true;
    lmds.push_back(lmd);
  }
}

void finish_critical(const Scene& scene, std::vector<Intersection>& intersections, CriticalSet& set) {
  LmdSet touching;
  append_contacts(scene, intersections, touching);
  for (const Lmd& lmd : touching) set.push_back({lmd, 1, true, true, true});
  sort_critical(set);
}

}  // namespace lmdbench
