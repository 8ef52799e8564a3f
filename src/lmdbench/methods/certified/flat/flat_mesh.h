// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/mesh/flat_regions.h>
#include <lmdbench/mesh/region_shape.h>

#include <span>
#include <vector>

namespace lmdbench {

/// The flat features of a mesh as `certified` searches them: a region stands for all its faces, a straight
/// edge for all its edges. Each is called by the first of those ("lead").
struct FlatMesh {
  const FlatRegions* regions = nullptr;  ///< Of the body, which outlives this.
  RegionShapes shapes;
  bool joins_features = false;  ///< Some region or straight edge has more than one face or edge.
  /// #R; whether has_inward_edge at a corner of the region, along its normal.
  std::vector<bool> region_has_inward_edge;
  /// #S; whether a triangle without area is on it, of which other edges may lie there too.
  std::vector<bool> straight_has_sliver;

  static FlatMesh of(const Body& body);

  std::int32_t lead_of_region(std::int32_t region) const { return regions->region_triangles[region].front(); }
  std::int32_t lead_of_straight(std::int32_t straight) const {
    return regions->edges_of_straight[straight].front();
  }
  /// Whether a hierarchy has a leaf for it: false inside a region or straight edge, and for all but leads.
  bool is_feature(const FeatureId& feature) const;
  /// Whether it is the lead of several.
  bool is_joined(const FeatureId& feature) const;
  /// Whether a region or straight edge (`index` counts those) is a single triangle or edge.
  bool is_single(const FeatureId& flat) const;
  /// Vertices that bound the feature: of a region its corners, of a straight edge its ends.
  void append_corners(const Surface& surface, const FeatureId& feature,
                      std::vector<std::int32_t>& corners) const;
  /// As FlatRegions::face_at, but it does not look at all faces.
  std::int32_t face_at(const Surface& surface, std::int32_t region, const Vec3& p_S) const;
  /// Whether a feature of the mesh lies on a region or straight edge (`flat.index` counts those), or on its
  /// border.
  bool is_on(const Surface& surface, const FeatureId& feature, const FeatureId& flat) const;
  /// Whether has_inward_edge at an end of a straight edge.
  bool straight_has_inward_edge(const Surface& surface, std::int32_t straight, const Vec3& n_S,
                                double reach) const;

 private:
  bool has_inward_edge(const Surface& surface, std::int32_t vertex, const FeatureId& flat, const Vec3& n_S,
                       double reach) const;
};

}  // namespace lmdbench
