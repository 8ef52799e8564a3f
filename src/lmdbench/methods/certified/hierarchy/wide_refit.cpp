// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/parallel.h>
#include <lmdbench/mesh/feature_corners.h>
#include <lmdbench/methods/certified/hierarchy/single_precision.h>
#include <lmdbench/methods/certified/hierarchy/wide_refit.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace lmdbench {

namespace {

/// Features that were given lanes, as a part of all, from which on the tree is built anew.
constexpr double MOST_INSERTED = 0.25;
/// Growth of inner lanes against those of features from which on it is.
constexpr double MOST_GROWTH = 1.6;
/// Steps that axes and centres are refined by: of nodes of features, which are many, and of others.
constexpr int AXIS_STEPS = 3, CENTRE_STEPS_OF_FEATURES = 2, CENTRE_STEPS = 4;
/// Features and nodes that one task takes at a time: what fewer cost is not worth a second thread.
constexpr std::size_t FEATURES_A_TASK = 4096, NODES_A_TASK = 1024;
/// Room that is left when the mesh outgrows the radius that is known of it, so that it does not do so in every step.
constexpr double RADIUS_ROOM = 1.1;

/// What a lane costs a traversal, up to a factor: lanes are opened the more often the larger they are and the wider their cones.
double lane_cost(const WideNode& node, std::uint32_t lane) {
  if (node.cosine[lane] == NO_LMD_COSINE) return 0.0;
  return static_cast<double>(node.radius[lane] * node.radius[lane] * (0.2F + node.sine[lane]));
}

Vec3 centre_of_lane(const WideNode& node, std::uint32_t lane) {
  return {node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]};
}

Vec3 axis_of_lane(const WideNode& node, std::uint32_t lane) {
  return {node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]};
}

/// Stores a cap, rounded outwards. @return the axis as it is stored
Vec3 store_cap(WideNode& node, std::uint32_t lane, const PolarCap& cap, bool carries_lmd) {
  Vec3 axis;
  for (int k = 0; k < 3; ++k) {
    node.axis[k][lane] = to_single(cap.axis[k]);
    axis[k] = static_cast<double>(node.axis[k][lane]);
  }
  const bool has_axis = !cap.is_all_directions();
  if (!carries_lmd) {
    node.cosine[lane] = NO_LMD_COSINE;
    node.sine[lane] = 0.0F;
  } else {
    node.cosine[lane] = has_axis ? std::max(0.0F, static_cast<float>(cap.cosine - CONE_ROUNDING)) : 0.0F;
    node.sine[lane] = has_axis ? std::min(1.0F, static_cast<float>(cap.sine + CONE_ROUNDING)) : 1.0F;
  }
  return axis;
}

/// Middle of the box of points, moved along the axis to the middle of their extent along it.
Vec3 middle_of(std::span<const Vec3> points, const Vec3& axis) {
  Vec3 low = points[0], high = low;
  double least = low.dot(axis), greatest = least;
  for (const Vec3& p : points.subspan(1)) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    const double along = p.dot(axis);
    least = std::min(least, along);
    greatest = std::max(greatest, along);
  }
  const Vec3 middle = 0.5 * (low + high);
  return middle + (0.5 * (least + greatest) - middle.dot(axis)) * axis;
}

/// As find_lane_centres (wide_bounds.h).
Vec3 refined_centre(std::span<const Vec3> points, const Vec3& axis, int steps) {
  Vec3 centre = middle_of(points, axis), best = centre;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= steps; ++step) {
    double farthest = -1.0;
    Vec3 to_farthest = Vec3::Zero();
    for (const Vec3& p : points) {
      const Vec3 to_point = p - centre;
      const double squared = to_point.squaredNorm();
      if (squared <= farthest) continue;
      farthest = squared;
      to_farthest = to_point;
    }
    if (farthest < least) {
      least = farthest;
      best = centre;
    }
    centre += 0.5 / (step + 2.0) * (to_farthest - to_farthest.dot(axis) * axis);
  }
  return best;
}

void store_centre(WideNode& node, std::uint32_t lane, const Vec3& centre) {
  for (int k = 0; k < 3; ++k) node.centre[k][lane] = to_single(centre[k]);
}

void store_sizes(WideNode& node, std::uint32_t lane, double radius, double thickness, bool has_axis,
                 double rounding) {
  node.radius[lane] = round_up_to_single(radius * (1.0 + 1e-15) + rounding);
  node.thickness[lane] =
      has_axis ? round_up_to_single(thickness * (1.0 + 1e-15) + rounding) : UNBOUNDED_THICKNESS;
}

/// Bounds points by a body about a centre along an axis, both as they are stored.
void bound_points(WideNode& node, std::uint32_t lane, std::span<const Vec3> points, const Vec3& axis,
                  double rounding) {
  const Vec3 centre = centre_of_lane(node, lane);
  double squared_radius = 0.0, thickness = 0.0;
  for (const Vec3& p : points) {
    const Vec3 from = p - centre;
    squared_radius = std::max(squared_radius, from.squaredNorm());
    thickness = std::max(thickness, std::abs(from.dot(axis)));
  }
  store_sizes(node, lane, std::sqrt(squared_radius), thickness, !axis.isZero(0.0), rounding);
}

/// Cone round the cones of a node's lanes.
/// @return false where no lane carries an LMD
bool cone_of_lanes(const WideNode& node, PolarCap& cap) {
  Vec3 axis = Vec3::Zero();
  bool any = false;
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    if (node.child[lane] == 0 || node.cosine[lane] == NO_LMD_COSINE) continue;
    any = true;
    const Vec3 own = axis_of_lane(node, lane);
    if (own.isZero(0.0)) return true;
    axis += own;
  }
  if (!any) return false;
  // As find_lane_axes (wide_bounds.h).
  const auto widest = [&](const Vec3& about) {
    double least = 2.0;
    Vec3 direction = about;
    for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      if (node.child[lane] == 0 || node.cosine[lane] == NO_LMD_COSINE) continue;
      const Vec3 own = axis_of_lane(node, lane);
      const double cosine = std::min(1.0, about.dot(own) / own.norm());
      const double own_cosine = static_cast<double>(node.cosine[lane]);
      const double sine = std::sqrt(std::max(0.0, 1.0 - own_cosine * own_cosine));
      const double reach = cosine * own_cosine - std::sqrt(1.0 - cosine * cosine) * sine;
      if (reach >= least) continue;
      least = reach;
      direction = own;
    }
    return std::pair(least, direction);
  };
  axis.normalize();
  Vec3 best_axis = axis;
  double best = -1.0;
  for (int step = 0; step <= AXIS_STEPS; ++step) {
    const auto [least, direction] = widest(axis);
    if (least > best) {
      best = least;
      best_axis = axis;
    }
    const Vec3 across = direction - axis.dot(direction) * axis;
    const double length = across.norm();
    if (!(length > 1e-6)) break;
    axis = (axis + std::sqrt(std::max(0.0, 1.0 - least * least)) / ((step + 2.0) * length) * across)
               .normalized();
  }
  best -= 8.0 * std::numeric_limits<double>::epsilon();
  // Wider than 90 degrees a cone is not convex (decision E1). Written so that an axis that is no number is refused.
  if (!(best > 0.0) || !best_axis.allFinite()) return true;
  cap = {best_axis, best, std::sqrt(std::max(0.0, 1.0 - best * best))};
  return true;
}

/// Bounds a lane that holds a feature of one vertex, edge or triangle.
void bound_feature(WideNode& node, std::uint32_t lane, const WideHierarchy& hierarchy, const Surface& surface,
                   const WideItem& item) {
  FeatureCorners corners(surface, item.ref.feature_id());
  std::array<Vec3, 3> points;
  std::size_t count = 0;
  for (const std::int32_t v : corners.view())
    points[count++] = surface.mesh.vertices[static_cast<std::size_t>(v)] - hierarchy.origin;
  const Vec3 axis = store_cap(node, lane, item.cap, item.carries_lmd);
  const std::span<const Vec3> own(points.data(), count);
  store_centre(node, lane, middle_of(own, axis));
  bound_points(node, lane, own, axis, hierarchy.rounding());
}

/// How far a lane's body reaches along a unit direction from its centre: as far as its sphere, or as the rim where its slab cuts the
/// sphere off.
double reach_of_lane(const WideNode& node, std::uint32_t lane, const Vec3& direction) {
  const double radius = static_cast<double>(node.radius[lane]);
  const double thickness = std::min(radius, static_cast<double>(node.thickness[lane]));
  const double cosine = std::min(1.0, std::abs(axis_of_lane(node, lane).dot(direction)));
  if (!(radius * cosine > thickness)) return radius;
  // Axes are unit up to rounding of single precision.
  return std::min(radius, thickness * cosine +
                              std::sqrt((radius * radius - thickness * thickness) * (1.0 - cosine * cosine)) +
                              1e-6 * radius);
}

/// Bounds a lane that holds a node: round the vertices of its features where it holds nothing else, or round its lanes' bounds.
void bound_node(WideNode& node, std::uint32_t lane, const WideHierarchy& hierarchy, const Surface& surface,
                const ShapeComplex& shape) {
  const WideNode& below = hierarchy.nodes[WideRef::from_bits(node.child[lane]).node_index()];
  PolarCap cap;
  const bool carries_lmd = cone_of_lanes(below, cap);
  const Vec3 axis = store_cap(node, lane, cap, carries_lmd);
  std::array<Vec3, 3 * WIDE_WIDTH> points;
  std::size_t count = 0, lanes = 0;
  bool all_plain = true;
  for (std::uint32_t l = 0; l < WIDE_WIDTH && all_plain; ++l) {
    const WideRef ref = WideRef::from_bits(below.child[l]);
    if (ref.is_empty()) continue;
    ++lanes;
    all_plain = ref.is_feature() && !shape.is_lead_of_several(ref.feature_id());
    if (!all_plain) break;
    const FeatureCorners corners(surface, ref.feature_id());
    for (const std::int32_t v : corners.view())
      points[count++] = surface.mesh.vertices[static_cast<std::size_t>(v)] - hierarchy.origin;
  }
  if (lanes == 0) {  // All its features have lost their cones.
    store_centre(node, lane, Vec3::Zero());
    store_sizes(node, lane, 0.0, 0.0, false, 0.0);
    return;
  }
  if (all_plain) {
    const std::span<const Vec3> own(points.data(), count);
    store_centre(node, lane, refined_centre(own, axis, CENTRE_STEPS_OF_FEATURES));
    bound_points(node, lane, own, axis, hierarchy.rounding());
    return;
  }
  count = 0;
  for (std::uint32_t l = 0; l < WIDE_WIDTH; ++l)
    if (below.child[l] != 0) points[count++] = centre_of_lane(below, l);
  store_centre(node, lane, refined_centre({points.data(), count}, axis, CENTRE_STEPS));
  const Vec3 centre = centre_of_lane(node, lane);
  double radius = 0.0, thickness = 0.0;
  for (std::uint32_t l = 0; l < WIDE_WIDTH; ++l) {
    if (below.child[l] == 0) continue;
    const Vec3 from = centre_of_lane(below, l) - centre;
    radius = std::max(radius, from.norm() + static_cast<double>(below.radius[l]));
    thickness = std::max(thickness, std::abs(from.dot(axis)) + reach_of_lane(below, l, axis));
  }
  store_sizes(node, lane, radius, thickness, !axis.isZero(0.0), hierarchy.rounding());
}

}  // namespace

WideRefit::WideRefit(const WideHierarchy& hierarchy, const Surface& surface) {
  slots_[static_cast<std::size_t>(FeatureKind::VERTEX)].assign(surface.mesh.vertices.size(), NO_SLOT);
  slots_[static_cast<std::size_t>(FeatureKind::EDGE)].assign(surface.adjacency.edges.size(), NO_SLOT);
  slots_[static_cast<std::size_t>(FeatureKind::FACE)].assign(surface.mesh.triangles.size(), NO_SLOT);
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
        // Nodes stand after those above them.
        parents_[ref.node_index()] = slot;
        depths_[ref.node_index()] = depths_[n] + 1;
      }
    }
  }
  marked_.resize(1 + *std::max_element(depths_.begin(), depths_.end()));
  cost_when_built_ = inner_over_leaves();
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

void WideRefit::update_features(WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex& shape,
                                FeatureKind kind, std::span<const std::int32_t> indices) {
  items_.resize(std::max(items_.size(), indices.size()));
  cost_changes_.resize(items_.size());
  // What has a lane is bounded in it at once: no two features share one.
  parallel_ranges(indices.size(), FEATURES_A_TASK, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FeatureId feature{kind, indices[i]};
      items_[i] = make_wide_item(surface, {}, &shape, feature);
      const std::uint32_t slot = slot_of(feature);
      if (!items_[i] || slot == NO_SLOT) continue;
      WideNode& node = hierarchy.nodes[slot / WIDE_WIDTH];
      const double before = lane_cost(node, slot % WIDE_WIDTH);
      bound_feature(node, slot % WIDE_WIDTH, hierarchy, surface, *items_[i]);
      cost_changes_[i] = lane_cost(node, slot % WIDE_WIDTH) - before;
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
      WideNode& node = hierarchy.nodes[slot / WIDE_WIDTH];
      bound_feature(node, slot % WIDE_WIDTH, hierarchy, surface, *items_[i]);
      leaf_cost_ += lane_cost(node, slot % WIDE_WIDTH);
    } else {
      leaf_cost_ += cost_changes_[i];
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
        cost_changes_[i] = 0.0;
        for (std::uint32_t left = marked_lanes_[nodes[i]]; left != 0; left &= left - 1) {
          const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
          const WideRef ref = WideRef::from_bits(node.child[lane]);
          if (ref.is_empty() || ref.is_feature()) continue;
          cost_changes_[i] -= lane_cost(node, lane);
          bound_node(node, lane, hierarchy, surface, shape);
          cost_changes_[i] += lane_cost(node, lane);
        }
      }
    });
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      inner_cost_ += cost_changes_[i];
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
  return static_cast<double>(inserted_) <= MOST_INSERTED * static_cast<double>(hierarchy.feature_count) &&
         inner_over_leaves() <= MOST_GROWTH * cost_when_built_;
}

}  // namespace lmdbench
