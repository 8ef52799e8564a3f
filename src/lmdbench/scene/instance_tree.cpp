// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/scene/instance_tree.h>

#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

namespace bg = boost::geometry;
using FloatPoint = bg::model::point<float, 3, bg::cs::cartesian>;
using FloatBox = bg::model::box<FloatPoint>;
using Entry = std::pair<FloatBox, std::uint32_t>;

/// An instance has one box.
struct SameInstance {
  bool operator()(const Entry& a, const Entry& b) const { return a.second == b.second; }
};

/// The next number of single precision that is not above x, or not below it.
float rounded_outwards(double x, bool down) {
  const auto near = static_cast<float>(x);
  if (down ? static_cast<double>(near) <= x : static_cast<double>(near) >= x) return near;
  const float end = std::numeric_limits<float>::infinity();
  return std::nextafter(near, down ? -end : end);
}

FloatBox grown(const Eigen::AlignedBox3d& box) {
  const auto point = [](const Eigen::Vector3d& p, bool down) {
    return FloatPoint(rounded_outwards(p.x(), down), rounded_outwards(p.y(), down),
                      rounded_outwards(p.z(), down));
  };
  return {point(box.min(), true), point(box.max(), false)};
}

double distance_of(const FloatPoint& p, const FloatBox& box) {
  const auto along = [](double x, double low, double high) { return std::max({0.0, low - x, x - high}); };
  return std::hypot(along(p.get<0>(), box.min_corner().get<0>(), box.max_corner().get<0>()),
                    along(p.get<1>(), box.min_corner().get<1>(), box.max_corner().get<1>()),
                    along(p.get<2>(), box.min_corner().get<2>(), box.max_corner().get<2>()));
}

/// Boost orders by squared distances in single precision, off by a few roundings of coordinates and
/// point: later ones may be nearer by this, over distance and coordinates.
constexpr double ORDER_ROUNDING = 1e-6;

}  // namespace

class InstanceTree::Tree {
 public:
  explicit Tree(const std::vector<Entry>& entries) : boxes(entries.begin(), entries.end()) {}
  // Packing ignores how nodes split; only moves do not. (GCC 12 takes the R*-tree's insertion for a
  // write beyond its nodes.)
  bg::index::rtree<Entry, bg::index::quadratic<8>, bg::index::indexable<Entry>, SameInstance> boxes;
};

InstanceTree::InstanceTree(std::span<const Eigen::AlignedBox3d> boxes) {
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    entries.emplace_back(grown(boxes[i]), static_cast<std::uint32_t>(i));
  tree_ = std::make_unique<Tree>(entries);
}

InstanceTree::~InstanceTree() = default;
InstanceTree::InstanceTree(InstanceTree&& other) noexcept = default;
InstanceTree& InstanceTree::operator=(InstanceTree&& other) noexcept = default;

void InstanceTree::move(std::uint32_t instance, const Eigen::AlignedBox3d& from,
                        const Eigen::AlignedBox3d& to) {
  tree_->boxes.remove(Entry(grown(from), instance));
  tree_->boxes.insert(Entry(grown(to), instance));
}

void InstanceTree::touching(const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& instances) const {
  instances.clear();
  const FloatBox asked = grown(box);
  tree_->boxes.query(
      bg::index::intersects(asked),
      boost::make_function_output_iterator([&](const Entry& entry) { instances.push_back(entry.second); }));
  std::sort(instances.begin(), instances.end());
}

void InstanceTree::by_distance(const Eigen::Vector3d& point,
                               const std::function<bool(std::uint32_t instance, double bound)>& visit) const {
  const FloatPoint asked(static_cast<float>(point.x()), static_cast<float>(point.y()),
                         static_cast<float>(point.z()));
  // More and more of the nearest: one query for all of them, incremental or not, sorts them all.
  constexpr std::size_t FIRST_ASKED = 8, MORE = 8;
  const std::size_t all = tree_->boxes.size();
  std::vector<Entry> found;
  std::vector<std::pair<double, std::uint32_t>> order;
  std::vector<std::uint32_t> visited;
  for (std::size_t count = FIRST_ASKED; visited.size() < all; count *= MORE) {
    found.clear();
    order.clear();
    tree_->boxes.query(bg::index::nearest(asked, static_cast<unsigned>(std::min(count, all))),
                       std::back_inserter(found));
    for (const Entry& entry : found)
      if (!std::binary_search(visited.begin(), visited.end(), entry.second))
        order.emplace_back(distance_of(asked, entry.first), entry.second);
    std::sort(order.begin(), order.end());
    for (const auto& [distance, instance] : order) {
      const double bound = distance - ORDER_ROUNDING * (distance + point.cwiseAbs().maxCoeff());
      if (!visit(instance, std::max(0.0, bound))) return;
      visited.push_back(instance);
    }
    std::sort(visited.begin(), visited.end());
  }
}

std::size_t InstanceTree::size() const {
  return tree_->boxes.size();
}

}  // namespace lmdbench
