// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>
#include <lmdbench/snch/polar_cap.h>
#include <lmdbench/snch/single_precision.h>
#include <lmdbench/snch/wide_bounds.h>
#include <lmdbench/snch/wide_hierarchy.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace lmdbench {

namespace {

constexpr std::size_t WIDTH = WIDE_WIDTH;
/// Sets smaller than this are divided by one thread.
constexpr std::size_t PARALLEL_GRAIN = 4096;
/// Widening of stored cosines and sines: a few roundings of single precision.
constexpr double CONE_ROUNDING = 5e-7;

/// A feature while the hierarchy is built.
struct Item {
  Vec3 centre;  ///< in the hierarchy's frame
  PolarCap cap;
  WideRef ref;
  bool carries_lmd;
  std::uint64_t code = 0;  ///< Morton code, for WideSplit::ORDER
};

/// Corners of a feature, at most three.
struct Corners {
  std::array<std::int32_t, 3> vertices{};
  std::size_t count = 0;

  Corners(const Surface& surface, const FeatureId& feature) {
    const auto index = static_cast<std::size_t>(feature.index);
    switch (feature.kind) {
      case FeatureKind::VERTEX:
        vertices[count++] = feature.index;
        break;
      case FeatureKind::EDGE:
        for (const std::int32_t vertex : surface.adjacency.edges[index]) vertices[count++] = vertex;
        break;
      case FeatureKind::FACE:
        for (const std::int32_t vertex : surface.mesh.triangles[index]) vertices[count++] = vertex;
        break;
    }
  }
  std::span<const std::int32_t> view() const { return {vertices.data(), count}; }
};

/// Cone of the normals of all faces round the feature's vertices: what a hierarchy over triangles would have
/// to use.
PolarCap one_ring_cap(const Surface& surface, const FeatureId& feature) {
  std::vector<Vec3> normals;
  const Corners corners(surface, feature);
  for (const std::int32_t vertex : corners.view()) {
    if (surface.vertex_is_boundary[static_cast<std::size_t>(vertex)]) return {};
    for (const std::int32_t triangle : surface.adjacency.vertex_triangles[vertex])
      normals.push_back(surface.face_normals[static_cast<std::size_t>(triangle)]);
  }
  const Cone cone = convex_cone_of_directions(normals);
  if (!(cone.cosine > 0.0)) return {};
  return {cone.axis, cone.cosine, cone.sine};
}

std::optional<Item> make_item(const Surface& surface, const WideBuildOptions& options, const Vec3& origin,
                              const FeatureId& feature) {
  const std::optional<PolarCap> cap = polar_cap(surface, feature);
  if (!cap && feature.kind != FeatureKind::FACE) return std::nullopt;
  Item item;
  item.ref = WideRef::feature(feature);
  item.carries_lmd = cap.has_value();
  if (cap) item.cap = options.tight_caps ? *cap : one_ring_cap(surface, feature);
  const Corners corners(surface, feature);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const std::int32_t vertex : corners.view()) {
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(vertex)];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  item.centre = 0.5 * (low + high) - origin;
  return item;
}

/// Features of one kind, in the order of their indices.
void append_items(const Surface& surface, const WideBuildOptions& options, const Vec3& origin,
                  FeatureKind kind, std::size_t count, std::vector<Item>& items) {
  std::vector<std::optional<Item>> found(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, PARALLEL_GRAIN), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      found[i] = make_item(surface, options, origin, {kind, static_cast<std::int32_t>(i)});
  });
  for (const auto& item : found)
    if (item) items.push_back(*item);
}

/// Sizes of the children's sets. Full nodes: every child but the last holds the same power of eight, so that
/// below the root only one path of nodes is partly empty.
struct Division {
  std::size_t unit;   ///< Sets are divided at multiples of this.
  std::size_t units;  ///< Number of children.
};

Division divide(std::size_t size, bool full_nodes) {
  if (size <= WIDTH) return {1, size};
  std::size_t unit = 1;
  if (full_nodes) {
    while (unit * WIDTH < size) unit *= WIDTH;
  } else {
    unit = (size + WIDTH - 1) / WIDTH;
  }
  return {unit, (size + unit - 1) / unit};
}

std::size_t count_nodes(std::size_t size, bool full_nodes) {
  if (size <= 1) return 0;
  const Division division = divide(size, full_nodes);
  std::size_t count = 1 + count_nodes(size - (division.units - 1) * division.unit, full_nodes);
  if (division.units > 1) count += (division.units - 1) * count_nodes(division.unit, full_nodes);
  return count;
}

class Builder {
 public:
  Builder(const Surface& surface, const WideBuildOptions& options, std::vector<Item>& items,
          WideHierarchy& result)
      : surface_(surface), options_(options), items_(items), result_(result) {}

  void build() {
    if (items_.empty()) return;
    if (options_.split == WideSplit::ORDER) sort_by_code();
    const std::size_t node_count =
        1 + std::max<std::size_t>(1, count_nodes(items_.size(), options_.full_nodes));
    result_.nodes.assign(node_count, WideNode{});
    bound(result_.nodes[0], 0, {0, items_.size()});
    result_.nodes[0].child[0] = WideRef::node(1).bits();
    build_node(1, {0, items_.size()});
  }

 private:
  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  void build_node(std::size_t node_index, const Range& range) {
    const Division division = divide(range.size(), options_.full_nodes);
    std::array<Range, WIDTH> children;
    std::size_t child_count = 0;
    split(range, division, division.units, children, child_count);

    WideNode& node = result_.nodes[node_index];
    std::array<std::size_t, WIDTH> child_nodes{};
    std::size_t next = node_index + 1;
    for (std::size_t lane = 0; lane < child_count; ++lane) {
      const Range& child = children[lane];
      child_nodes[lane] = next;
      node.child[lane] = child.size() == 1 ? items_[child.begin].ref.bits()
                                           : WideRef::node(static_cast<std::uint32_t>(next)).bits();
      next += count_nodes(child.size(), options_.full_nodes);
    }
    const auto finish = [&](std::size_t lane) {
      bound(node, lane, children[lane]);
      if (children[lane].size() > 1) build_node(child_nodes[lane], children[lane]);
    };
    if (range.size() > PARALLEL_GRAIN) {
      tbb::parallel_for(std::size_t{0}, child_count, finish);
    } else {
      for (std::size_t lane = 0; lane < child_count; ++lane) finish(lane);
    }
  }

  /// Bisects until one unit is left, always at a multiple of the unit.
  void split(const Range& range, const Division& division, std::size_t units,
             std::array<Range, WIDTH>& children, std::size_t& child_count) {
    if (units <= 1) {
      children[child_count++] = range;
      return;
    }
    const std::size_t left_units = (units + 1) / 2;
    const std::size_t middle = range.begin + left_units * division.unit;
    if (options_.split != WideSplit::ORDER) partition(range, middle);
    split({range.begin, middle}, division, left_units, children, child_count);
    split({middle, range.end}, division, units - left_units, children, child_count);
  }

  void partition(const Range& range, std::size_t middle) {
    const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(range.begin);
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(range.end);
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    Vec3 low_axis = low, high_axis = high;
    for (auto item = begin; item != end; ++item) {
      low = low.cwiseMin(item->centre);
      high = high.cwiseMax(item->centre);
      low_axis = low_axis.cwiseMin(item->cap.axis);
      high_axis = high_axis.cwiseMax(item->cap.axis);
    }
    int axis = 0;
    const double extent = (high - low).maxCoeff(&axis);
    int axis_of_cones = 0;
    const double spread = (high_axis - low_axis).maxCoeff(&axis_of_cones);
    const bool by_cone = options_.split == WideSplit::NORMAL &&
                         spread * options_.normal_weight * 2.0 * result_.radius > extent;
    const auto key = [&](const Item& item) {
      return by_cone ? item.cap.axis[axis_of_cones] : item.centre[axis];
    };
    // Ties are broken by the feature, so that the result does not depend on how the library partitions.
    std::nth_element(begin, items_.begin() + static_cast<std::ptrdiff_t>(middle), end,
                     [&](const Item& a, const Item& b) {
                       const double key_a = key(a), key_b = key(b);
                       return key_a != key_b ? key_a < key_b : a.ref.bits() < b.ref.bits();
                     });
  }

  void sort_by_code() {
    constexpr double CELLS = 1 << 21;
    for (Item& item : items_) {
      item.code = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double cell = (item.centre[axis] / std::max(result_.radius, 1e-300) + 1.0) * 0.5 * CELLS;
        const auto index = static_cast<std::uint64_t>(std::clamp(cell, 0.0, CELLS - 1.0));
        for (std::uint64_t bit = 0; bit < 21; ++bit)
          item.code |= (index >> bit & 1u) << (3u * bit + static_cast<std::uint64_t>(axis));
      }
    }
    std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
      return a.code != b.code ? a.code < b.code : a.ref.bits() < b.ref.bits();
    });
  }

  /// Steps that the bounds of a set are refined by: more for the small sets, of which most tests are made,
  /// and where a step is cheap. Against none they save a quarter of the tests.
  static int refinement_steps(std::size_t size) {
    if (size == 1) return 0;
    return size <= WIDTH * WIDTH ? 8 : 2;
  }

  /// Bounds of one child, rounded outwards.
  void bound(WideNode& node, std::size_t lane, const Range& range) const {
    thread_local std::vector<PolarCap> caps;
    thread_local std::vector<std::int32_t> vertices;
    thread_local std::vector<Vec3> points;
    caps.clear();
    vertices.clear();
    points.clear();
    bool carries_lmd = false, all_directions = false;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Item& item = items_[i];
      const Corners corners(surface_, item.ref.feature_id());
      vertices.insert(vertices.end(), corners.view().begin(), corners.view().end());
      if (!item.carries_lmd) continue;
      carries_lmd = true;
      all_directions = all_directions || item.cap.is_all_directions();
      caps.push_back(item.cap);
    }
    // Neighbouring features share most of their corners; where few steps go over them that is not worth
    // sorting out.
    if (range.size() <= WIDTH * WIDTH && range.size() > 1) {
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
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
  }

  const Surface& surface_;
  const WideBuildOptions& options_;
  std::vector<Item>& items_;
  WideHierarchy& result_;
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

  std::vector<Item> items;
  append_items(surface, options, result.origin, FeatureKind::VERTEX, surface.mesh.vertices.size(), items);
  append_items(surface, options, result.origin, FeatureKind::EDGE, surface.adjacency.edges.size(), items);
  append_items(surface, options, result.origin, FeatureKind::FACE, surface.mesh.triangles.size(), items);
  result.feature_count = items.size();
  result.least_edge = std::numeric_limits<double>::infinity();
  for (const auto& ends : surface.adjacency.edges)
    result.least_edge =
        std::min(result.least_edge, (surface.mesh.vertices[static_cast<std::size_t>(ends[0])] -
                                     surface.mesh.vertices[static_cast<std::size_t>(ends[1])])
                                        .norm());
  Builder(surface, options, items, result).build();
  return result;
}

}  // namespace lmdbench
