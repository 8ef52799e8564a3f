// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/exhaustive/feature_grid.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench {

namespace {

/// Most cells along the longest side of the mesh's box: bounds memory for few huge and many tiny
/// triangles.
constexpr int MAXIMUM_CELLS_PER_SIDE = 96;
/// Most cells a box covers on average; else cells are larger. Long triangles round one vertex would
/// each cover a good part of all.
constexpr double MOST_CELLS_A_BOX = 64.0;

}  // namespace

Eigen::AlignedBox3d box_of_vertices(const Surface& surface, std::span<const std::int32_t> vertices) {
  Eigen::AlignedBox3d box;
  for (const std::int32_t v : vertices) box.extend(surface.mesh.vertices[static_cast<std::size_t>(v)]);
  return box;
}

FeatureGrid::FeatureGrid(const Surface& surface) {
  const auto add = [&](FeatureKind kind, std::size_t count) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i) {
      features_.push_back({kind, i});
      boxes_.push_back(box_of_vertices(surface, FeatureCorners(surface, features_.back()).view()));
      bounds_.extend(boxes_.back());
    }
  };
  add(FeatureKind::VERTEX, surface.mesh.vertices.size());
  add(FeatureKind::EDGE, surface.adjacency.edges.size());
  add(FeatureKind::FACE, surface.mesh.triangles.size());
  if (boxes_.empty()) return;
  last_query_.assign(boxes_.size(), 0);

  // A surface of T triangles crosses about T cells when the longest side has sqrt(T) of them.
  const double longest = bounds_.sizes().maxCoeff();
  const double cells = std::clamp(std::sqrt(static_cast<double>(surface.mesh.triangles.size())), 1.0,
                                  double{MAXIMUM_CELLS_PER_SIDE});
  for (int axis = 0; axis < 3; ++axis)
    size_[axis] = longest > 0.0 ? std::max(1, static_cast<int>(cells * bounds_.sizes()[axis] / longest)) : 1;
  const auto measure_cells = [&] {
    for (int axis = 0; axis < 3; ++axis) {
      const double side = bounds_.sizes()[axis];
      cells_per_metre_[axis] = side > 0.0 ? size_[axis] / side : 0.0;
    }
  };
  const auto covered_cells = [&] {
    double sum = 0.0;
    for (const auto& box : boxes_) sum += (cell_of(box.max()) - cell_of(box.min()) + 1).cast<double>().prod();
    return sum;
  };
  for (measure_cells(); covered_cells() > MOST_CELLS_A_BOX * static_cast<double>(boxes_.size());
       measure_cells())
    size_ = (size_ + 1) / 2;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Eigen::Array3i first = cell_of(boxes_[i].min()), last = cell_of(boxes_[i].max());
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x)
          pairs.emplace_back((z * size_.y() + y) * size_.x() + x, static_cast<std::int32_t>(i));
  }
  cells_ = CsrRows(size_.prod(), pairs);
}

Eigen::Array3i FeatureGrid::cell_of(const Vec3& point) const {
  Eigen::Array3i cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = (point[axis] - bounds_.min()[axis]) * cells_per_metre_[axis];
    cell[axis] = static_cast<int>(std::clamp(position, 0.0, static_cast<double>(size_[axis] - 1)));
  }
  return cell;
}

}  // namespace lmdbench
