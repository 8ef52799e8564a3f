// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/methods/certified/build/wide_items.h>
#include <lmdbench/methods/certified/deform/clear_vertex.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/shape/shape_complex.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lmdbench {

/// Lets a wide hierarchy follow a mesh that deforms (DEFORMATION.md).
///
/// 1. *Lanes.* Each feature whose wings changed gets a new polar cap. A reflex edge that turns
///    convex or a saddle that becomes a peak gets a lane, beside one of its faces; a feature
///    without a cap loses its lane.
/// 2. *Bounds*, from the lanes of changed features up: features are bounded by their vertices,
///    nodes by the bounds of lanes below. Lanes below which nothing changed stay as they are.
/// 3. The tree is to be built anew once many features were given lanes, or inner lanes have grown
///    too much against those of features.
class WideRefit {
 public:
  WideRefit(const WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape);

  /// @param change  of the surface; the shape's regions and chains are those of the build
  /// @return false where the hierarchy is to be built anew
  bool refit(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape,
             const SurfaceChange& change);

 private:
  static constexpr std::uint32_t NO_SLOT = 0xFFFFFFFFU;

  std::uint32_t& slot_of(const FeatureId& feature) {
    return slots_[static_cast<std::size_t>(feature.kind)][static_cast<std::size_t>(feature.index)];
  }
  void mark(std::uint32_t slot);
  void update_features(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape,
                       FeatureKind kind, std::span<const std::int32_t> indices);
  std::optional<WideItem> vertex_item(const Surface& surface, const ShapeComplex& shape, std::int32_t vertex);
  void insert(WideHierarchy& hierarchy, const Surface& surface, const FeatureId& feature);
  void remove(WideHierarchy& hierarchy, const FeatureId& feature);
  void refit_marked(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape);
  struct CostChange {
    double inner = 0.0, leaf = 0.0;
  };

  double inner_over_leaves() const { return inner_cost_ / leaf_cost_; }

  /// By kind: node * 8 + lane of each feature, or NO_SLOT.
  std::array<std::vector<std::uint32_t>, 3> slots_;
  std::vector<SaddleWitness> witnesses_;            ///< #V: of vertices that are clear saddles.
  std::vector<WingSet> bounding_wings_;             ///< #V: of other vertices; 0: unknown.
  std::vector<std::uint32_t> parents_;              ///< #nodes: the slot above each; of the root 0.
  std::vector<std::uint32_t> depths_;               ///< #nodes: number of nodes above each.
  std::vector<std::uint32_t> marked_lanes_;         ///< #nodes: bits of lanes changed in or below.
  std::vector<std::vector<std::uint32_t>> marked_;  ///< By depth: nodes with such lanes.
  double inner_cost_ = 0.0, leaf_cost_ = 0.0;       ///< Sums of lane_cost.
  double cost_when_built_ = 0.0;  ///< inner_over_leaves of the built tree, inner bounds refitted.
  std::size_t inserted_ = 0;
  std::vector<std::optional<WideItem>> items_;  ///< Scratch: of updated features of a kind.
  std::vector<double> costs_;                   ///< Scratch: of their lanes before.
  std::vector<CostChange> cost_changes_;        ///< Scratch: by nodes.
};

}  // namespace lmdbench
