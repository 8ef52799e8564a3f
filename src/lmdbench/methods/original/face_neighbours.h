// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// A face and those across its edges (paper, Fig. 5 (a), wider reading): up to four. None is across
/// a boundary edge; of more than two triangles at an edge the one of least index is.
class FaceNeighbours {
 public:
  explicit FaceNeighbours(const Surface& surface) {
    const auto& adjacency = surface.adjacency;
    rows_.reserve(adjacency.triangle_edges.size());
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(adjacency.triangle_edges.size()); ++t) {
      Row row{{t}, 1};
      for (const std::int32_t edge : adjacency.triangle_edges[static_cast<std::size_t>(t)])
        for (const std::int32_t other : adjacency.edge_triangles[edge])
          if (other != t) {
            row.triangles[row.size++] = other;
            break;
          }
      rows_.push_back(row);
    }
  }

  TriangleList of(std::int32_t face) const {
    const Row& row = rows_[static_cast<std::size_t>(face)];
    return TriangleList(std::span<const std::int32_t>(row.triangles.data(), row.size));
  }

 private:
  struct Row {
    std::array<std::int32_t, 4> triangles;
    std::size_t size;
  };
  std::vector<Row> rows_;
};

}  // namespace lmdbench
