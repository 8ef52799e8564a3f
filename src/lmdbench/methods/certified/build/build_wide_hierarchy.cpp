// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/build/wide_bounds.h>
#include <lmdbench/methods/certified/build/wide_items.h>
#include <lmdbench/methods/certified/build/wide_partition.h>
#include <lmdbench/methods/certified/layout/single_precision.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/layout/wide_lane.h>
#include <lmdbench/shape/shape_complex.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace lmdbench {

namespace {

constexpr std::size_t WIDTH = WIDE_WIDTH;

/// Regions are long from this ratio of length to width on.
constexpr double LONG = 4.0;
/// Widths are kept where at least this part of all faces are long regions
/// (`scripts/tuned_constants.py --only LEAST_LONG_SHARE experiments/extreme/peg-square.json`).
constexpr double LEAST_LONG_SHARE = 0.25;

struct Range {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};

/// Drops repeated vertices of a list, by a mark for each of the mesh: cheaper than to sort.
class Deduplicator {
 public:
  explicit Deduplicator(std::size_t vertex_count) : marks_(vertex_count, 0) {}

  /// Keeps the first of equal vertices, from position `begin` on.
  void drop_repeated(std::vector<std::int32_t>& vertices, std::size_t begin) {
    ++mark_;
    std::size_t kept = begin;
    for (std::size_t i = begin; i < vertices.size(); ++i) {
      std::uint32_t& mark = marks_[static_cast<std::size_t>(vertices[i])];
      if (mark == mark_) continue;
      mark = mark_;
      vertices[kept++] = vertices[i];
    }
    vertices.resize(kept);
  }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t mark_ = 0;  ///< One a node: fewer than 2^29.
};

/// @param shape  null: of the mesh itself
void append_corners(const Surface& surface, const ShapeComplex* shape, const FeatureId& feature,
                    std::vector<std::int32_t>& corners) {
  if (shape != nullptr) return shape->append_corners(surface, feature, corners);
  const FeatureCorners own(surface, feature);
  corners.insert(corners.end(), own.view().begin(), own.view().end());
}

/// Of one thread. Not to be held while it waits for other tasks: it may work on them.
struct BuildScratch {
  Deduplicator deduplicator;
  LaneCaps caps;
  LaneSets points;

  explicit BuildScratch(std::size_t vertex_count) : deduplicator(vertex_count) {}
};

/// One child of a node while the node is made.
struct Lane {
  Range items{};
  std::vector<std::int32_t> own_list;      ///< Where another thread made the child.
  std::span<const std::int32_t> vertices;  ///< Those of its features.
  bool carries_lmd = false;
  bool may_have_cone = true;  ///< False where a cone below is known to be all directions.
};

/// Node tests of a query (cutoff 2 % of the diagonal, two bunnies of 16,298 triangles, commit
/// 2c9786a): 856. Halved at the middle 1,134, by cone axes too 877 to 6,308, Morton order 3,296,
/// cones of normals 2,204, width 4 1,240; two features a lane 768, 6 to 11 times the pairs left.
/// Makes the nodes over items in the order of the tree, children before parents: a parent's bounds
/// are round the same features, but use each vertex once.
class Builder {
 public:
  Builder(const Surface& surface, const std::vector<WideItem>& items, const ShapeComplex* shape,
          WideHierarchy& result)
      : surface_(surface), items_(items), shape_(shape), result_(result), scratch_([&surface] {
          return BuildScratch(surface.mesh.vertices.size());
        }) {}

  void build() {
    if (items_.empty()) return;
    const Range all{0, items_.size()};
    const std::size_t node_count = 1 + std::max<std::size_t>(1, count_wide_nodes(items_.size()));
    result_.nodes.assign(node_count, WideNode{});
    if (has_long_features()) result_.widths.assign(node_count, WideWidths{});
    result_.nodes[0].child[0] = WideRef::node(1).bits();
    std::vector<std::int32_t> vertices;
    std::array<Lane, 1> root;
    root[0].items = all;
    root[0].may_have_cone = build_node(1, all, vertices, scratch_.local());
    root[0].vertices = vertices;
    bound(0, root, scratch_.local());
  }

 private:
  /// Appends the vertices of the node's features to a list.
  /// @return false when the cone of some child is all directions: then the parent's is too
  bool build_node(std::size_t node_index, const Range& range, std::vector<std::int32_t>& vertices,
                  BuildScratch& scratch) {
    const WideDivision division(range.size());
    const std::size_t nodes_below = count_wide_nodes(division.unit);
    WideNode& node = result_.nodes[node_index];
    std::array<Lane, WIDTH> storage;
    const std::span<Lane> lanes(storage.data(), division.children);
    const auto first_node = [&](std::size_t lane) { return node_index + 1 + lane * nodes_below; };
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const std::size_t begin = range.begin + i * division.unit;
      lanes[i].items = {begin, std::min(range.end, begin + division.unit)};
      node.child[i] = lanes[i].items.size() == 1
                          ? items_[begin].ref.bits()
                          : WideRef::node(static_cast<std::uint32_t>(first_node(i))).bits();
    }

    const std::size_t before = vertices.size();
    if (range.size() > SMALLEST_PARALLEL_SET) {
      parallel_for(lanes.size(), [&](std::size_t i) {
        Lane& lane = lanes[i];
        lane.may_have_cone = build_child(first_node(i), lane.items, lane.own_list, scratch_.local());
        lane.vertices = lane.own_list;
      });
      for (const Lane& lane : lanes)
        vertices.insert(vertices.end(), lane.own_list.begin(), lane.own_list.end());
    } else {
      std::array<std::size_t, WIDTH + 1> starts{};
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        starts[i] = vertices.size();
        lanes[i].may_have_cone = build_child(first_node(i), lanes[i].items, vertices, scratch);
      }
      starts[lanes.size()] = vertices.size();
      for (std::size_t i = 0; i < lanes.size(); ++i)
        lanes[i].vertices = std::span(vertices).subspan(starts[i], starts[i + 1] - starts[i]);
    }
    const bool all_have_cones = bound(node_index, lanes, scratch);
    scratch.deduplicator.drop_repeated(vertices, before);
    return all_have_cones;
  }

  bool build_child(std::size_t node_index, const Range& range, std::vector<std::int32_t>& vertices,
                   BuildScratch& scratch) {
    if (range.size() > 1) return build_node(node_index, range, vertices, scratch);
    append_corners(surface_, shape_, items_[range.begin].ref.feature_id(), vertices);
    return true;
  }

  /// Refinement steps of a set's bounds: more for small sets, of which most tests are made. They
  /// save a quarter of the tests; many more would save one in a hundred.
  static int refinement_steps(std::size_t size) {
    if (size == 1) return 0;
    return size <= WIDTH * WIDTH ? 24 : 8;
  }

  /// Bounds of a node's children, rounded outwards.
  /// @return false when the cone of some child is all directions
  bool bound(std::size_t node_index, std::span<Lane> lanes, BuildScratch& scratch) const {
    WideNode& node = result_.nodes[node_index];
    const int steps = refinement_steps(lanes.front().items.size());
    const std::array<PolarCap, WIDTH> caps = enclosing_caps(lanes, steps, scratch);
    LaneVectors axes{};
    bool all_have_cones = true;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      // All directions have the axis zero.
      store_cap(node, static_cast<std::uint32_t>(i), caps[i], lanes[i].carries_lmd);
      axes.x[i] = node.axis[0][i];
      axes.y[i] = node.axis[1][i];
      axes.z[i] = node.axis[2][i];
      all_have_cones = all_have_cones && !(lanes[i].carries_lmd && caps[i].is_all_directions());
    }
    bound_bodies(node, lanes, axes, steps, scratch);
    if (!result_.widths.empty())
      for (std::size_t i = 0; i < lanes.size(); ++i)
        bound_width(node, result_.widths[node_index], static_cast<std::uint32_t>(i), lanes[i].vertices);
    return all_have_cones;
  }

  /// Cones around the caps of each lane's features.
  std::array<PolarCap, WIDTH> enclosing_caps(std::span<Lane> lanes, int steps, BuildScratch& scratch) const {
    std::array<PolarCap, WIDTH> result;
    bool any = false;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      Lane& lane = lanes[i];
      for (const WideItem& item : items_of(lane)) {
        if (!item.carries_lmd) continue;
        lane.carries_lmd = true;
        lane.may_have_cone = lane.may_have_cone && !item.cap.is_all_directions();
        if (!lane.may_have_cone) break;
      }
      lane.may_have_cone = lane.may_have_cone && lane.carries_lmd;
      any = any || lane.may_have_cone;
      if (lane.items.size() == 1) result[i] = items_[lane.items.begin].cap;
    }
    const std::size_t size = lanes.front().items.size();
    if (!any || size == 1) return result;

    LaneCaps& caps = scratch.caps;
    caps.resize(size);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      if (!lanes[i].may_have_cone) continue;
      std::size_t k = 0;
      const auto put = [&](const PolarCap& cap) {
        caps.axes.set(k, i, cap.axis);
        caps.cosines[k * WIDTH + i] = static_cast<float>(cap.cosine);
        caps.sines[k * WIDTH + i] = static_cast<float>(cap.sine);
        ++k;
      };
      const PolarCap* last = nullptr;
      for (const WideItem& item : items_of(lanes[i]))
        if (item.carries_lmd) put(*(last = &item.cap));
      while (k < size) put(*last);
    }
    LaneVectors axes{};
    find_lane_axes(caps, steps, axes);
    for (std::size_t i = 0; i < lanes.size(); ++i)
      if (lanes[i].may_have_cone) result[i] = measured_cap(lanes[i], Vec3(axes.x[i], axes.y[i], axes.z[i]));
    return result;
  }

  /// Cone around the axis; all directions from 90 degrees on, where it is not convex (decision E1).
  PolarCap measured_cap(const Lane& lane, const Vec3& axis) const {
    PolarCap cap;
    cap.axis = axis.normalized();
    cap.cosine = 1.0;
    for (const WideItem& item : items_of(lane)) {
      if (!item.carries_lmd) continue;
      const double cosine = std::min(1.0, cap.axis.dot(item.cap.axis));
      const double nearest = cosine * item.cap.cosine;
      if (nearest - item.cap.sine >= cap.cosine) continue;  // most need no root
      cap.cosine =
          std::min(cap.cosine, nearest - std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) * item.cap.sine);
    }
    cap.cosine -= 4.0 * std::numeric_limits<double>::epsilon();
    // Written so that an axis that is no number is refused.
    if (!(cap.cosine > 0.0) || !cap.axis.allFinite()) return {};
    cap.sine = std::sqrt(std::max(0.0, 1.0 - cap.cosine * cap.cosine));
    return cap;
  }

  void bound_bodies(WideNode& node, std::span<const Lane> lanes, const LaneVectors& axes, int steps,
                    BuildScratch& scratch) const {
    std::size_t size = 0;
    for (const Lane& lane : lanes) size = std::max(size, lane.vertices.size());
    LaneSets& points = scratch.points;
    points.resize(size);
    std::array<Vec3, WIDTH> anchors;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      // From a point of the set: so small sets lose no digits.
      const auto& vertices = lanes[i].vertices;
      anchors[i] = vertex(vertices.front());
      for (std::size_t k = 0; k < size; ++k)
        points.set(k, i, vertex(vertices[std::min(k, vertices.size() - 1)]) - anchors[i]);
    }
    LaneVectors offsets{};
    find_lane_centres(points, axes, steps, offsets);

    const double rounding = result_.rounding();
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const Vec3 middle = anchors[i] - result_.origin + Vec3(offsets.x[i], offsets.y[i], offsets.z[i]);
      const Vec3 axis(axes.x[i], axes.y[i], axes.z[i]);
      Vec3 centre;
      for (int k = 0; k < 3; ++k) {
        node.centre[k][i] = to_single(middle[k]);
        centre[k] = node.centre[k][i];
      }
      double squared_radius = 0.0, thickness = 0.0;
      for (const std::int32_t index : lanes[i].vertices) {
        const Vec3 from_centre = vertex(index) - result_.origin - centre;
        squared_radius = std::max(squared_radius, from_centre.squaredNorm());
        thickness = std::max(thickness, std::abs(from_centre.dot(axis)));
      }
      node.radius[i] = round_up_to_single(std::sqrt(squared_radius) * (1.0 + 1e-15) + rounding);
      node.thickness[i] = axis.isZero(0.0) ? UNBOUNDED_THICKNESS : round_up_to_single(thickness + rounding);
    }
  }

  /// Whether long regions are a large part of all faces, as of pegs, gears and gratings. Other
  /// meshes, scans above all, shall not pay for a test that rejects nothing.
  bool has_long_features() const {
    std::size_t faces = 0, long_ones = 0;
    for (const WideItem& item : items_) {
      if (shape_ == nullptr || !item.ref.is_face()) continue;
      ++faces;
      const std::int32_t region = shape_->region_of(item.ref.feature_id().index);
      const RegionShape* const shape = region < 0 ? nullptr : shape_->shapes.of_region(region);
      if (shape == nullptr) continue;
      Box2 box;
      for (const Vec2& corner : shape->hull) box.add(corner);
      if (LONG * width_of(shape->hull) <= (box.high - box.low).norm()) ++long_ones;
    }
    return long_ones > 0 && LEAST_LONG_SHARE * static_cast<double>(faces) <= static_cast<double>(long_ones);
  }

  /// Along the shorter principal axis of the vertices in the plane square to the cone's axis: any
  /// direction in it is right, and of a wall or a row of walls this is the narrowest.
  void bound_width(const WideNode& node, WideWidths& widths, std::uint32_t lane,
                   std::span<const std::int32_t> vertices) const {
    const Vec3 axis = axis_of_lane(node, lane);
    if (axis.isZero(0.0)) return;
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u).normalized(), origin = vertex(vertices.front());
    Vec2 sum = Vec2::Zero();
    Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
    for (const std::int32_t index : vertices) {
      const Vec3 x = vertex(index) - origin;
      const Vec2 flat(x.dot(u), x.dot(v));
      sum += flat;
      products += flat * flat.transpose();
    }
    products -= sum * sum.transpose() / static_cast<double>(vertices.size());
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
    principal.computeDirect(products);
    const Vec2 shorter = principal.eigenvectors().col(0);
    if (!shorter.allFinite()) return;
    const Vec3 direction = shorter[0] * u + shorter[1] * v;
    Vec3 across;
    for (int k = 0; k < 3; ++k) across[k] = to_single(direction[k]);
    const Vec3 centre = centre_of_lane(node, lane);
    double width = 0.0;
    for (const std::int32_t index : vertices)
      width = std::max(width, std::abs((vertex(index) - result_.origin - centre).dot(across)));
    const float half_width = round_up_to_single(width + result_.rounding());
    if (2.0F * half_width > node.radius[lane]) return;
    for (int k = 0; k < 3; ++k) widths.across[k][lane] = static_cast<float>(across[k]);
    widths.half_width[lane] = half_width;
  }

  std::span<const WideItem> items_of(const Lane& lane) const {
    return std::span(items_).subspan(lane.items.begin, lane.items.size());
  }
  const Vec3& vertex(std::int32_t index) const {
    return surface_.mesh.vertices[static_cast<std::size_t>(index)];
  }

  const Surface& surface_;
  const std::vector<WideItem>& items_;
  const ShapeComplex* shape_;
  WideHierarchy& result_;
  PerThread<BuildScratch> scratch_;
};

}  // namespace

bool bounds_what_is_below(const WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex* shape) {
  std::vector<std::int32_t> corners;
  // Features below each node, from the last node back: nodes come after those above them.
  std::vector<std::vector<FeatureId>> below(hierarchy.nodes.size());
  const auto holds = [&](std::size_t n, std::uint32_t lane, const FeatureId& feature) {
    const WideNode& node = hierarchy.nodes[n];
    const Vec3 centre = centre_of_lane(node, lane), axis = axis_of_lane(node, lane);
    corners.clear();
    append_corners(surface, shape, feature, corners);
    return std::ranges::all_of(corners, [&](std::int32_t corner) {
      const Vec3 p = surface.mesh.vertices[static_cast<std::size_t>(corner)] - hierarchy.origin;
      if (p.norm() > hierarchy.radius) return false;
      const Vec3 x = p - centre;
      if (!hierarchy.widths.empty()) {
        const WideWidths& widths = hierarchy.widths[n];
        const Vec3 across(widths.across[0][lane], widths.across[1][lane], widths.across[2][lane]);
        if (std::abs(x.dot(across)) > static_cast<double>(widths.half_width[lane])) return false;
      }
      return x.norm() <= static_cast<double>(node.radius[lane]) &&
             std::abs(x.dot(axis)) <= static_cast<double>(node.thickness[lane]);
    });
  };
  for (std::size_t n = hierarchy.nodes.size(); n-- > 0;) {
    for (std::uint32_t lane = 0; lane < WIDTH; ++lane) {
      const WideRef ref = WideRef::from_bits(hierarchy.nodes[n].child[lane]);
      if (ref.is_empty()) continue;
      const std::vector<FeatureId> features =
          ref.is_feature() ? std::vector<FeatureId>{ref.feature_id()} : std::move(below[ref.node_index()]);
      for (const FeatureId& feature : features)
        if (!holds(n, lane, feature)) return false;
      below[n].insert(below[n].end(), features.begin(), features.end());
    }
  }
  return true;
}

WideHierarchy build_wide_hierarchy(const Surface& surface, const ShapeComplex* shape,
                                   const SignedFeatures* signs) {
  WideHierarchy result;
  if (surface.mesh.triangles.empty()) return result;
  result.origin = bounding_box_centre(surface.mesh);
  double squared_radius = 0.0;
  for (const Vec3& p : surface.mesh.vertices)
    squared_radius = std::max(squared_radius, (p - result.origin).squaredNorm());
  result.radius = std::sqrt(squared_radius) * (1.0 + 1e-15);

  std::vector<WideItem> items = collect_wide_items(surface, shape, signs);
  partition_wide_items(surface, shape, result.origin, items);
  result.feature_count = items.size();
  Builder(surface, items, shape, result).build();
  LMDBENCH_ENSURES(bounds_what_is_below(result, surface, shape), "a bound that was not rounded outwards");
  return result;
}

}  // namespace lmdbench
