// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/exhaustive/triangle_grid.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench {

namespace {

/// Cells along the longest side of the mesh's box at the most: bounds the memory for meshes with a few huge
/// and many tiny triangles.
constexpr int MAXIMUM_CELLS_PER_SIDE = 96;

}  // namespace

Eigen::AlignedBox3d bounding_box(const Triangle& triangle) {
  Eigen::AlignedBox3d box(triangle[0]);
  box.extend(triangle[1]);
  box.extend(triangle[2]);
  return box;
}

TriangleGrid::TriangleGrid(const TriangleMesh& mesh) {
  const auto triangle_count = static_cast<std::int32_t>(mesh.triangles.size());
  boxes_.reserve(mesh.triangles.size());
  for (std::int32_t t = 0; t < triangle_count; ++t) {
    boxes_.push_back(bounding_box(mesh.triangle(t)));
    bounds_.extend(boxes_.back());
  }
  if (boxes_.empty()) return;
  last_query_.assign(boxes_.size(), 0);

  // A surface of T triangles crosses about T cells when the longest side has sqrt(T) of them.
  const double longest = bounds_.sizes().maxCoeff();
  const double cells =
      std::clamp(std::sqrt(static_cast<double>(triangle_count)), 1.0, double{MAXIMUM_CELLS_PER_SIDE});
  for (int axis = 0; axis < 3; ++axis) {
    const double side = bounds_.sizes()[axis];
    size_[axis] = longest > 0.0 ? std::max(1, static_cast<int>(cells * side / longest)) : 1;
    cells_per_metre_[axis] = side > 0.0 ? size_[axis] / side : 0.0;
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> cell_triangles;
  for (std::int32_t t = 0; t < triangle_count; ++t) {
    const auto& box = boxes_[static_cast<std::size_t>(t)];
    const Eigen::Array3i first = cell_of(box.min()), last = cell_of(box.max());
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x)
          cell_triangles.emplace_back((z * size_.y() + y) * size_.x() + x, t);
  }
  cells_ = CsrRows(size_.prod(), cell_triangles);
}

Eigen::Array3i TriangleGrid::cell_of(const Vec3& point) const {
  Eigen::Array3i cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = (point[axis] - bounds_.min()[axis]) * cells_per_metre_[axis];
    cell[axis] = static_cast<int>(std::clamp(position, 0.0, static_cast<double>(size_[axis] - 1)));
  }
  return cell;
}

}  // namespace lmdbench
