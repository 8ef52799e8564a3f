// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/deform/refit_bounds.h>
#include <lmdbench/methods/certified/deform/wide_refit.h>
#include <lmdbench/methods/certified/layout/wide_lane.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace lmdbench {

namespace {

/// The tree is built anew from this share of features on that were given lanes ...
constexpr double MOST_INSERTED = 0.25;
/// ... or this growth of inner lanes against those of features (scripts/tuned_constants.py --only
/// MOST_GROWTH experiments/deforming.json).
constexpr double MOST_GROWTH = 1.3;
/// Features and nodes of a task: fewer are not worth a second thread.
constexpr std::size_t FEATURES_A_TASK = 4096, NODES_A_TASK = 1024;
/// Room when the mesh outgrows its radius, so that it does not do so in every step.
constexpr double RADIUS_ROOM = 1.1;

}  // namespace

WideRefit::WideRefit(const WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape) {
  slots_[static_cast<std::size_t>(FeatureKind::VERTEX)].assign(surface.mesh.vertices.size(), NO_SLOT);
  slots_[static_cast<std::size_t>(FeatureKind::EDGE)].assign(surface.adjacency.edges.size(), NO_SLOT);
  slots_[static_cast<std::size_t>(FeatureKind::FACE)].assign(surface.mesh.triangles.size(), NO_SLOT);
  witnesses_.assign(surface.mesh.vertices.size(), NO_WITNESS);
  bounding_wings_.assign(surface.mesh.vertices.size(), 0);
  parents_.assign(hierarchy.nodes.size(), 0);
  depths_.assign(hierarchy.nodes.size(), 0);
  marked_lanes_.assign(hierarchy.nodes.size(), 0);
  for (std::uint32_t n = 0; n < hierarchy.nodes.size(); ++n) {
    for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      const WideRef ref = WideRef::from_bits(hierarchy.nodes[n].child[lane]);
      if (ref.is_empty()) continue;
      const std::uint32_t slot = n * WIDE_WIDTH + lane;
      (ref.is_feature() ? leaf_cost_ : inner_cost_) += lane_cost(hierarchy.nodes[n], lane);
      if (ref.is_feature()) {
        slot_of(ref.feature_id()) = slot;
      } else {
        // Nodes come after those above them.
        parents_[ref.node_index()] = slot;
        depths_[ref.node_index()] = depths_[n] + 1;
      }
    }
  }
  marked_.resize(1 + *std::max_element(depths_.begin(), depths_.end()));
  // Growth is measured against refitted bounds, which are larger than built ones.
  WideHierarchy merged = hierarchy;
  const double built = inner_cost_;
  for (std::uint32_t n = 1; n < hierarchy.nodes.size(); ++n) mark(parents_[n]);
  refit_marked(merged, surface, shape);
  cost_when_built_ = inner_over_leaves();
  inner_cost_ = built;
}

void WideRefit::mark(std::uint32_t slot) {
  const std::uint32_t node = slot / WIDE_WIDTH;
  if (marked_lanes_[node] == 0) marked_[depths_[node]].push_back(node);
  marked_lanes_[node] |= 1u << slot % WIDE_WIDTH;
}

void WideRefit::remove(WideHierarchy& hierarchy, const FeatureId& feature) {
  const std::uint32_t slot = std::exchange(slot_of(feature), NO_SLOT);
  WideNode& node = hierarchy.nodes[slot / WIDE_WIDTH];
  leaf_cost_ -= lane_cost(node, slot % WIDE_WIDTH);
  node.child[slot % WIDE_WIDTH] = WideRef().bits();
  hierarchy.changes.lanes[slot / WIDE_WIDTH] = hierarchy.changes.now;
  --hierarchy.feature_count;
  mark(slot);
}

void WideRefit::insert(WideHierarchy& hierarchy, const Surface& surface, const FeatureId& feature) {
  // Beside a face, where its node has a lane to spare. Faces of single triangles always have lanes.
  std::uint32_t slot = NO_SLOT, beside = NO_SLOT;
  for (const std::int32_t face : surface.incident_triangles(feature)) {
    const std::uint32_t home = slot_of({FeatureKind::FACE, face});
    if (home == NO_SLOT) continue;
    if (beside == NO_SLOT) beside = home;
    const WideNode& node = hierarchy.nodes[home / WIDE_WIDTH];
    for (std::uint32_t lane = 0; lane < WIDE_WIDTH && slot == NO_SLOT; ++lane)
      if (node.child[lane] == 0) slot = home / WIDE_WIDTH * WIDE_WIDTH + lane;
    if (slot != NO_SLOT) break;
  }
  if (slot == NO_SLOT) {
    // The face moves into a node of its own, with the feature.
    const auto added = static_cast<std::uint32_t>(hierarchy.nodes.size());
    hierarchy.nodes.emplace_back();
    hierarchy.changes.bounds.push_back(hierarchy.changes.now);
    hierarchy.changes.lanes.push_back(hierarchy.changes.now);
    parents_.push_back(beside);
    depths_.push_back(depths_[beside / WIDE_WIDTH] + 1);
    marked_lanes_.push_back(0);
    if (depths_.back() >= marked_.size()) marked_.resize(depths_.back() + 1);
    WideNode &above = hierarchy.nodes[beside / WIDE_WIDTH], &own = hierarchy.nodes[added];
    const std::uint32_t lane = beside % WIDE_WIDTH;
    for (int k = 0; k < 3; ++k) {
      own.centre[k][0] = above.centre[k][lane];
      own.axis[k][0] = above.axis[k][lane];
    }
    own.radius[0] = above.radius[lane];
    own.thickness[0] = above.thickness[lane];
    own.cosine[0] = above.cosine[lane];
    own.sine[0] = above.sine[lane];
    own.child[0] = above.child[lane];
    slot_of(WideRef::from_bits(own.child[0]).feature_id()) = added * WIDE_WIDTH;
    above.child[lane] = WideRef::node(added).bits();
    inner_cost_ += lane_cost(above, lane);
    hierarchy.changes.lanes[beside / WIDE_WIDTH] = hierarchy.changes.now;
    if ((marked_lanes_[beside / WIDE_WIDTH] >> lane & 1u) != 0)
      mark(added * WIDE_WIDTH);  // Still to be bounded.
    mark(beside);
    slot = added * WIDE_WIDTH + 1;
  }
  WideNode& node = hierarchy.nodes[slot / WIDE_WIDTH];
  node.child[slot % WIDE_WIDTH] = WideRef::feature(feature).bits();
  node.cosine[slot % WIDE_WIDTH] = NO_LMD_COSINE;  // Costs nothing yet.
  slot_of(feature) = slot;
  hierarchy.changes.lanes[slot / WIDE_WIDTH] = hierarchy.changes.now;
  ++hierarchy.feature_count;
  ++inserted_;
}

/// As make_wide_item. Wings are the neighbours: else the shape would have been made anew.
std::optional<WideItem> WideRefit::vertex_item(const Surface& surface, const ShapeComplex& shape,
                                               std::int32_t vertex) {
  SaddleWitness& witness = witnesses_[static_cast<std::size_t>(vertex)];
  const double least_wing = LEAST_WING * shape.regions.extent;
  if (witness != NO_WITNESS && is_clear_saddle(surface, vertex, witness, least_wing)) return std::nullopt;
  const FeatureId feature{FeatureKind::VERTEX, vertex};
  WingSet& bounding = bounding_wings_[static_cast<std::size_t>(vertex)];
  if (bounding == 0)
    if (const std::optional<PolarCap> cap = clear_peak_cap(surface, vertex, least_wing))
      return WideItem{*cap, WideRef::feature(feature), true};
  std::optional<WideItem> item = make_wide_item(surface, &shape, nullptr, feature, &bounding);
  if (!item) witness = find_saddle_witness(surface, vertex);
  return item;
}

void WideRefit::update_features(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape,
                                FeatureKind kind, std::span<const std::int32_t> indices) {
  items_.resize(std::max(items_.size(), indices.size()));
  costs_.resize(items_.size());
  // The cone of a feature with a lane is stored at once: no two share one.
  parallel_ranges(indices.size(), FEATURES_A_TASK, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FeatureId feature{kind, indices[i]};
      items_[i] = kind == FeatureKind::VERTEX ? vertex_item(surface, shape, feature.index)
                                              : make_wide_item(surface, &shape, nullptr, feature);
      const std::uint32_t slot = slot_of(feature);
      if (!items_[i] || slot == NO_SLOT) continue;
      WideNode& node = hierarchy.nodes[slot / WIDE_WIDTH];
      costs_[i] = lane_cost(node, slot % WIDE_WIDTH);
      store_cap(node, slot % WIDE_WIDTH, items_[i]->cap, items_[i]->carries_lmd);
    }
  });
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const FeatureId feature{kind, indices[i]};
    if (!items_[i]) {
      if (slot_of(feature) != NO_SLOT) remove(hierarchy, feature);
      continue;
    }
    if (slot_of(feature) == NO_SLOT) {
      insert(hierarchy, surface, feature);
      const std::uint32_t slot = slot_of(feature);
      store_cap(hierarchy.nodes[slot / WIDE_WIDTH], slot % WIDE_WIDTH, items_[i]->cap,
                items_[i]->carries_lmd);
    } else {
      leaf_cost_ -= costs_[i];  // Until its body is bounded.
    }
    mark(slot_of(feature));
  }
}

void WideRefit::refit_marked(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape) {
  for (std::size_t depth = marked_.size(); depth-- > 0;) {
    const std::vector<std::uint32_t>& nodes = marked_[depth];
    cost_changes_.resize(std::max(cost_changes_.size(), nodes.size()));
    parallel_ranges(nodes.size(), NODES_A_TASK, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        WideNode& node = hierarchy.nodes[nodes[i]];
        cost_changes_[i] = {};
        std::uint32_t lanes = 0;
        for (std::uint32_t left = marked_lanes_[nodes[i]]; left != 0; left &= left - 1) {
          const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
          const WideRef ref = WideRef::from_bits(node.child[lane]);
          if (ref.is_empty()) continue;
          lanes |= 1u << lane;
          if (!ref.is_feature()) cost_changes_[i].inner -= lane_cost(node, lane);
        }
        refit_lanes(node, lanes, hierarchy, surface, shape);
        for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
          const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
          (WideRef::from_bits(node.child[lane]).is_feature() ? cost_changes_[i].leaf
                                                             : cost_changes_[i].inner) +=
              lane_cost(node, lane);
        }
      }
    });
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      inner_cost_ += cost_changes_[i].inner;
      leaf_cost_ += cost_changes_[i].leaf;
      marked_lanes_[nodes[i]] = 0;
      hierarchy.changes.bounds[nodes[i]] = hierarchy.changes.now;
      if (nodes[i] != 0) mark(parents_[nodes[i]]);  // Of the depth above.
    }
    marked_[depth].clear();
  }
}

bool WideRefit::refit(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape,
                      const SurfaceChange& change) {
  double squared_radius = 0.0;
  for (const std::int32_t v : change.moved)
    squared_radius =
        std::max(squared_radius,
                 (surface.mesh.vertices[static_cast<std::size_t>(v)] - hierarchy.origin).squaredNorm());
  if (const double radius = std::sqrt(squared_radius) * (1.0 + 1e-15); radius > hierarchy.radius) {
    hierarchy.radius = RADIUS_ROOM * radius;
    hierarchy.changes.frame = hierarchy.changes.now;
  }
  // Faces first: others find their places beside them.
  update_features(hierarchy, surface, shape, FeatureKind::FACE, change.faces);
  update_features(hierarchy, surface, shape, FeatureKind::EDGE, change.edges);
  update_features(hierarchy, surface, shape, FeatureKind::VERTEX, change.vertices);
  refit_marked(hierarchy, surface, shape);
  LMDBENCH_ENSURES(bounds_what_is_below(hierarchy, surface, &shape),
                   "a lane that does not know of a change below it");
  return static_cast<double>(inserted_) <= MOST_INSERTED * static_cast<double>(hierarchy.feature_count) &&
         inner_over_leaves() <= MOST_GROWTH * cost_when_built_;
}

}  // namespace lmdbench
