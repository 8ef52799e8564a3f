// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/parallel.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/methods/certified/build/clear_vertex.h>
#include <lmdbench/methods/certified/build/refit_bounds.h>
#include <lmdbench/methods/certified/build/wide_items.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/shape/shape_complex.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lmdbench {

/// Brings a wide hierarchy to a mesh that deforms (DEFORMATION.md).
///
/// 1. *The leaf set follows.* Each feature whose wings changed is asked anew for its polar cap: a reflex edge that turns convex, a
///    saddle that becomes a peak get a lane, beside a face that they belong to; what loses its cap loses its lane.
/// 2. *Bounds follow*, from the lanes of changed features up. A node of features is bounded by their vertices, one of nodes by
///    its lanes' bounds; lanes below which nothing changed stay as they are.
///
/// Where counters say that the tree is no longer what a builder would make, it is to be built anew: when many features were
/// given lanes, and when inner lanes have grown against those of features.
class WideRefit {
 public:
  WideRefit(const WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape);

  /// @param change of the surface; no region or chain of the shape is another one than it was when the hierarchy was built
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
  double inner_over_leaves() const { return inner_cost_ / leaf_cost_; }

  /// By kind: node * 8 + lane of each feature, or NO_SLOT.
  std::array<std::vector<std::uint32_t>, 3> slots_;
  std::vector<SaddleWitness> witnesses_;     ///< #V: why a vertex has no cap, where that is plain.
  std::vector<std::uint32_t> parents_;       ///< #nodes: the slot above each; of the root 0.
  std::vector<std::uint32_t> depths_;        ///< #nodes: nodes above each.
  std::vector<std::uint32_t> marked_lanes_;  ///< #nodes: bits of the lanes that changed or whose nodes did.
  std::vector<std::vector<std::uint32_t>> marked_;  ///< By depth: nodes with such lanes.
  double inner_cost_ = 0.0, leaf_cost_ = 0.0;       ///< Sums of lane_cost.
  double cost_when_built_ = 0.0;  ///< inner_over_leaves of the built tree with all inner bounds refitted.
  std::size_t inserted_ = 0;
  std::vector<std::optional<WideItem>> items_;  ///< Scratch: of the features of a kind that are updated.
  std::vector<double> cost_changes_;            ///< Scratch.
  std::unique_ptr<PerThread<InnerBounds>> bounds_;
};

}  // namespace lmdbench
