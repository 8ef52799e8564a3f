// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/single_precision.h>
#include <lmdbench/snch/wide_bounds.h>
#include <lmdbench/snch/wide_hierarchy.h>
#include <lmdbench/snch/wide_items.h>
#include <lmdbench/snch/wide_partition.h>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace lmdbench {

namespace {

constexpr std::size_t WIDTH = WIDE_WIDTH;
/// Sets smaller than this are divided by one thread.
constexpr std::size_t PARALLEL_GRAIN = 4096;
/// Widening of stored cosines and sines: a few roundings of single precision.
constexpr double CONE_ROUNDING = 5e-7;

struct Range {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};

/// Drops what was seen before in a list of vertices. One a thread, with a mark for every vertex of the mesh:
/// much cheaper than to sort.
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
  std::uint32_t mark_ = 0;  ///< Fewer lists than nodes, of which there are fewer than 2^29.
};

/// Makes the nodes over items that are in the order of the tree, children before parents: a parent's bounds
/// are taken of the same features, but of each vertex once.
class Builder {
 public:
  Builder(const Surface& surface, const WideBuildOptions& options, const std::vector<WideItem>& items,
          WideHierarchy& result)
      : surface_(surface), options_(options), items_(items), result_(result), deduplicators_([&surface] {
          return Deduplicator(surface.mesh.vertices.size());
        }) {}

  void build() {
    if (items_.empty()) return;
    const Range all{0, items_.size()};
    const std::size_t node_count =
        1 + std::max<std::size_t>(1, count_wide_nodes(items_.size(), options_.full_nodes));
    result_.nodes.assign(node_count, WideNode{});
    result_.nodes[0].child[0] = WideRef::node(1).bits();
    std::vector<std::int32_t> vertices;
    const bool has_cone = build_node(1, all, vertices);
    bound(result_.nodes[0], 0, all, vertices, has_cone);
  }

 private:
  /// Appends the vertices of the node's features to a list.
  /// @return false when the cone of some child is all directions: then the parent's is too
  bool build_node(std::size_t node_index, const Range& range, std::vector<std::int32_t>& vertices) {
    WideNode& node = result_.nodes[node_index];
    const WideDivision division(range.size(), options_.full_nodes);
    std::array<std::size_t, WIDTH> child_nodes{};
    std::size_t next = node_index + 1;
    const std::size_t nodes_below = count_wide_nodes(division.unit, options_.full_nodes);
    const auto child_range = [&](std::size_t lane) {
      const std::size_t begin = range.begin + lane * division.unit;
      return Range{begin, std::min(range.end, begin + division.unit)};
    };
    for (std::size_t lane = 0; lane < division.children; ++lane) {
      child_nodes[lane] = next;
      const Range child = child_range(lane);
      node.child[lane] = child.size() == 1 ? items_[child.begin].ref.bits()
                                           : WideRef::node(static_cast<std::uint32_t>(next)).bits();
      next +=
          child.size() == division.unit ? nodes_below : count_wide_nodes(child.size(), options_.full_nodes);
    }

    const std::size_t before = vertices.size();
    std::array<bool, WIDTH> have_cones{};
    const auto build_lane = [&](std::size_t lane, std::vector<std::int32_t>& list) {
      const Range child = child_range(lane);
      const std::size_t start = list.size();
      bool has_cone = true;
      if (child.size() == 1) {
        const FeatureCorners corners(surface_, items_[child.begin].ref.feature_id());
        list.insert(list.end(), corners.view().begin(), corners.view().end());
      } else {
        has_cone = build_node(child_nodes[lane], child, list);
      }
      have_cones[lane] = bound(node, lane, child, std::span(list).subspan(start), has_cone);
    };
    if (range.size() > PARALLEL_GRAIN) {
      std::array<std::vector<std::int32_t>, WIDTH> lists;
      tbb::parallel_for(std::size_t{0}, division.children,
                        [&](std::size_t lane) { build_lane(lane, lists[lane]); });
      for (const auto& list : lists) vertices.insert(vertices.end(), list.begin(), list.end());
    } else {
      for (std::size_t lane = 0; lane < division.children; ++lane) build_lane(lane, vertices);
    }
    deduplicators_.local().drop_repeated(vertices, before);
    return std::all_of(have_cones.begin(),
                       have_cones.begin() + static_cast<std::ptrdiff_t>(division.children),
                       [](bool has_cone) { return has_cone; });
  }

  /// Steps that the bounds of a set are refined by: more for the small sets, of which most tests are made,
  /// and where a step is cheap. Against none they save a quarter of the tests.
  static int refinement_steps(std::size_t size) {
    if (size == 1) return 0;
    return size <= WIDTH * WIDTH ? 8 : 2;
  }

  /// Bounds of one child, rounded outwards.
  /// @param may_have_cone false where a cone is known to be all directions
  /// @return false when the cone is all directions
  bool bound(WideNode& node, std::size_t lane, const Range& range, std::span<const std::int32_t> vertices,
             bool may_have_cone) const {
    thread_local std::vector<PolarCap> caps;
    thread_local std::vector<Vec3> points;
    caps.clear();
    points.clear();
    bool carries_lmd = false, all_directions = !may_have_cone;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const WideItem& item = items_[i];
      if (!item.carries_lmd) continue;
      carries_lmd = true;
      all_directions = all_directions || item.cap.is_all_directions();
      if (all_directions) break;
      caps.push_back(item.cap);
    }
    for (const std::int32_t vertex : vertices)
      points.push_back(surface_.mesh.vertices[static_cast<std::size_t>(vertex)] - result_.origin);

    const int steps = refinement_steps(range.size());
    const PolarCap cap = carries_lmd && !all_directions ? enclosing_cap(caps, steps) : PolarCap{};
    const bool has_axis = !cap.is_all_directions();
    const Eigen::Vector3f axis(to_single(cap.axis[0]), to_single(cap.axis[1]), to_single(cap.axis[2]));
    const Vec3 rounded_axis = axis.cast<double>();
    const Vec3 middle = disc_centre(points, rounded_axis, steps);
    const Eigen::Vector3f centre(to_single(middle[0]), to_single(middle[1]), to_single(middle[2]));
    const Vec3 rounded_centre = centre.cast<double>();
    double squared_radius = 0.0, thickness = 0.0;
    for (const Vec3& p : points) {
      squared_radius = std::max(squared_radius, (p - rounded_centre).squaredNorm());
      thickness = std::max(thickness, std::abs((p - rounded_centre).dot(rounded_axis)));
    }

    // Corners were moved to the origin in double precision; that rounding is 1e-16 of the mesh and is added
    // too.
    const double rounding =
        4.0 * std::numeric_limits<double>::epsilon() * (result_.radius + result_.origin.norm());
    for (int k = 0; k < 3; ++k) {
      node.centre[k][lane] = centre[k];
      node.axis[k][lane] = axis[k];
    }
    node.radius[lane] = round_up_to_single(std::sqrt(squared_radius) * (1.0 + 1e-15) + rounding);
    node.thickness[lane] = has_axis ? round_up_to_single(thickness + rounding) : UNBOUNDED_THICKNESS;
    if (!carries_lmd) {
      node.cosine[lane] = NO_LMD_COSINE;
      node.sine[lane] = 0.0F;
    } else {
      node.cosine[lane] = has_axis ? std::max(0.0F, static_cast<float>(cap.cosine - CONE_ROUNDING)) : 0.0F;
      node.sine[lane] = has_axis ? std::min(1.0F, static_cast<float>(cap.sine + CONE_ROUNDING)) : 1.0F;
    }
    return has_axis || !carries_lmd;
  }

  const Surface& surface_;
  const WideBuildOptions& options_;
  const std::vector<WideItem>& items_;
  WideHierarchy& result_;
  tbb::enumerable_thread_specific<Deduplicator> deduplicators_;
};

}  // namespace

WideHierarchy build_wide_hierarchy(const Surface& surface, const WideBuildOptions& options) {
  WideHierarchy result;
  if (surface.mesh.triangles.empty()) return result;
  result.origin = bounding_box_centre(surface.mesh);
  double squared_radius = 0.0;
  for (const Vec3& p : surface.mesh.vertices)
    squared_radius = std::max(squared_radius, (p - result.origin).squaredNorm());
  result.radius = std::sqrt(squared_radius) * (1.0 + 1e-15);

  std::vector<WideItem> items = collect_wide_items(surface, options);
  partition_wide_items(surface, options, result.origin, result.radius, items);
  result.feature_count = items.size();
  double squared_least = std::numeric_limits<double>::infinity();
  for (const auto& ends : surface.adjacency.edges)
    squared_least = std::min(squared_least, (surface.mesh.vertices[static_cast<std::size_t>(ends[0])] -
                                             surface.mesh.vertices[static_cast<std::size_t>(ends[1])])
                                                .squaredNorm());
  result.least_edge = std::sqrt(squared_least);
  Builder(surface, options, items, result).build();
  return result;
}

}  // namespace lmdbench
