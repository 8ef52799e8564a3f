// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/orientation.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_intersection.h>
#include <lmdbench/mesh/self_intersections.h>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr std::size_t LEAF_TRIANGLES = 4;

/// Boxes over ranges of the triangles' order; a node is before its children.
struct BoxNode {
  Box box;
  std::size_t begin = 0, end = 0;
  std::size_t left = 0, right = 0;  ///< 0: a leaf.
};

class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes, std::vector<std::int32_t> order)
      : boxes_(std::move(boxes)), order_(std::move(order)) {
    if (!order_.empty()) build(0, order_.size());
  }

  /// Calls `look(a, b)` for pairs whose boxes overlap, until it returns false.
  template <typename Look>
  void overlapping_pairs(Look&& look) const {
    std::vector<std::pair<std::size_t, std::size_t>> stack;
    if (!nodes_.empty()) stack.emplace_back(0, 0);
    while (!stack.empty()) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      const BoxNode& a = nodes_[i];
      const BoxNode& b = nodes_[j];
      if (i != j && !a.box.intersects(b.box)) continue;
      if (a.left == 0 && b.left == 0) {
        if (!look_at_leaves(a, b, i == j, look)) return;
      } else if (i == j) {
        stack.insert(stack.end(), {{a.left, a.left}, {a.left, a.right}, {a.right, a.right}});
      } else if (b.left == 0 || (a.left != 0 && a.end - a.begin >= b.end - b.begin)) {
        stack.insert(stack.end(), {{a.left, j}, {a.right, j}});
      } else {
        stack.insert(stack.end(), {{i, b.left}, {i, b.right}});
      }
    }
  }

 private:
  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    Box box, centres;
    Vec3 extents = Vec3::Zero();
    for (std::size_t k = begin; k < end; ++k) {
      const Box& own = boxes_[static_cast<std::size_t>(order_[k])];
      box.extend(own);
      centres.extend(own.center());
      extents += own.sizes();
    }
    std::size_t left = 0, right = 0;
    if (end - begin > LEAF_TRIANGLES) {
      // By centres over box sizes: halves of long, parallel spikes would overlap.
      Eigen::Index axis = 0;
      const double least = std::numeric_limits<double>::min();
      centres.sizes().cwiseQuotient((extents.array() + least).matrix()).maxCoeff(&axis);
      const std::size_t middle = begin + (end - begin) / 2;
      const auto at = [this](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
      std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
        const double x = boxes_[static_cast<std::size_t>(a)].center()[axis];
        const double y = boxes_[static_cast<std::size_t>(b)].center()[axis];
        return x != y ? x < y : a < b;
      });
      left = build(begin, middle);
      right = build(middle, end);
    }
    nodes_[index] = {box, begin, end, left, right};
    return index;
  }

  template <typename Look>
  bool look_at_leaves(const BoxNode& a, const BoxNode& b, bool same, Look&& look) const {
    for (std::size_t k = a.begin; k < a.end; ++k)
      for (std::size_t l = same ? k + 1 : b.begin; l < b.end; ++l) {
        const std::int32_t first = order_[k];
        const std::int32_t second = order_[l];
        if (!boxes_[static_cast<std::size_t>(first)].intersects(boxes_[static_cast<std::size_t>(second)]))
          continue;
        if (!look(std::min(first, second), std::max(first, second))) return false;
      }
    return true;
  }

  std::vector<Box> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<BoxNode> nodes_;
};

/// Exactly collinear corners, or fewer than three different ones.
bool has_no_area(const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis)
    if (orientation_2d(t[0], t[1], t[2], axis) != 0) return false;
  return true;
}

/// Two triangles on one edge fold onto each other: one plane, apexes on the same side.
bool fold_over(const Vec3& p, const Vec3& q, const Vec3& apex_a, const Vec3& apex_b) {
  if (orientation_3d(p, q, apex_a, apex_b) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int side = orientation_2d(p, q, apex_a, axis);
    if (side != 0) return side == orientation_2d(p, q, apex_b, axis);
  }
  return false;
}

bool segment_meets(const Vec3& p, const Vec3& q, const Triangle& t) {
  return triangles_intersect({p, q, q}, t);
}

/// Whether they share a point beyond common corners and sides.
bool meet_elsewhere(const Triangle& a, const Triangle& b) {
  std::vector<std::pair<std::size_t, std::size_t>> common;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (a[i] == b[j]) common.emplace_back(i, j);
  switch (common.size()) {
    case 0:
      return triangles_intersect(a, b);
    case 1: {
      const auto [i, j] = common.front();
      return segment_meets(a[(i + 1) % 3], a[(i + 2) % 3], b) ||
             segment_meets(b[(j + 1) % 3], b[(j + 2) % 3], a);
    }
    case 2: {
      const auto [i, j] = common[0];
      const auto [k, l] = common[1];
      return fold_over(a[i], a[k], a[3 - i - k], b[3 - j - l]);
    }
    default:
      return false;
  }
}

}  // namespace

SelfIntersections self_intersections(const TriangleMesh& given, std::int64_t most_pairs) {
  // Scaled by a power of two, which is exact: triple products neither overflow nor vanish.
  TriangleMesh mesh = given;
  const double largest = largest_coordinate(mesh.vertices);
  if (largest > 0.0)
    for (Vec3& vertex : mesh.vertices)
      for (double& coordinate : vertex) coordinate = std::ldexp(coordinate, -std::ilogb(largest));
  std::vector<Box> boxes(mesh.triangles.size());
  std::vector<std::int32_t> with_area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle corners = mesh.triangle(static_cast<std::int32_t>(t));
    for (const Vec3& corner : corners) boxes[t].extend(corner);
    if (!has_no_area(corners)) with_area.push_back(static_cast<std::int32_t>(t));
  }
  SelfIntersections found;
  std::int64_t looked_at = 0;
  const BoxTree tree(std::move(boxes), std::move(with_area));
  tree.overlapping_pairs([&](std::int32_t i, std::int32_t j) {
    if (++looked_at > most_pairs) {
      found.complete = false;
      return false;
    }
    if (!meet_elsewhere(mesh.triangle(i), mesh.triangle(j))) return true;
    ++found.pairs;
    const std::array<std::int32_t, 2> pair{i, j};
    if (!found.first || pair < *found.first) found.first = pair;
    return true;
  });
  return found;
}

std::string to_text(const SelfIntersections& found) {
  std::string text = found.pairs == 0 ? std::string("none")
                                      : fmt::format("{}{} pairs of triangles touch or cross, first {} and {}",
                                                    found.complete ? "" : "at least ", found.pairs,
                                                    (*found.first)[0], (*found.first)[1]);
  if (!found.complete) text += fmt::format(" (the search ended after {} pairs)", MOST_SELF_PAIRS);
  return text;
}

}  // namespace lmdbench
