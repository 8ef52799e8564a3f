// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/mesh/feature.h>
#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// Axis-aligned bounding box of some vertices.
Eigen::AlignedBox3d box_of_vertices(const Surface& surface, std::span<const std::int32_t> vertices);

/// Uniform grid over a mesh's vertices, edges and faces: lists those whose boxes lie within a
/// distance of a query box. Used by one thread at a time.
class FeatureGrid {
 public:
  explicit FeatureGrid(const Surface& surface);

  /// Calls `visit(feature)` once for each whose box is within `distance` [m] of `box`, by cells.
  template <class Visitor>
  void for_each_near(const Eigen::AlignedBox3d& box, double distance, Visitor&& visit) {
    if (boxes_.empty() || bounds_.squaredExteriorDistance(box) > distance * distance) return;
    ++query_;
    const Vec3 margin = Vec3::Constant(distance);
    const Eigen::Array3i first = cell_of(box.min() - margin), last = cell_of(box.max() + margin);
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x)
          for (const std::int32_t entry : cells_[(z * size_.y() + y) * size_.x() + x]) {
            const auto i = static_cast<std::size_t>(entry);
            if (last_query_[i] == query_) continue;
            last_query_[i] = query_;
            if (boxes_[i].squaredExteriorDistance(box) <= distance * distance) visit(features_[i]);
          }
  }

  std::size_t bytes() const {
    return features_.capacity() * sizeof(FeatureId) + boxes_.capacity() * sizeof(Eigen::AlignedBox3d) +
           cells_.bytes() + last_query_.capacity() * sizeof(std::uint64_t);
  }

 private:
  /// Cell that holds a point, clamped to the grid.
  Eigen::Array3i cell_of(const Vec3& point) const;

  Eigen::AlignedBox3d bounds_;
  Eigen::Array3i size_ = Eigen::Array3i::Ones();
  Vec3 cells_per_metre_ = Vec3::Zero();
  std::vector<FeatureId> features_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  CsrRows cells_;
  std::vector<std::uint64_t> last_query_;  ///< Stamp of the query that visited the feature last.
  std::uint64_t query_ = 0;
};

}  // namespace lmdbench
