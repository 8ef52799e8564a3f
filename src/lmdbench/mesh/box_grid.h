// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/mesh/csr_rows.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace lmdbench {

/// Uniform grid over boxes of a plane, about one box a cell: lists those near a box or a segment.
class BoxGrid {
 public:
  BoxGrid() : BoxGrid(std::vector<Box2>()) {}
  explicit BoxGrid(std::vector<Box2> boxes);

  const Vec2& low() const { return bounds_.low; }
  const Vec2& high() const { return bounds_.high; }
  std::size_t bytes() const { return boxes_.capacity() * sizeof(Box2) + cells_.bytes(); }

  /// Calls visit(index) once for every box within `within` of a box, until it returns false.
  /// @return whether visit never returned false
  template <class Visit>
  bool for_each_near(const Box2& box, double within, Visit&& visit) const {
    LMDBENCH_EXPECTS(within >= 0.0, "a tolerance that is negative or not a number");
    const auto [x0, y0] = cell_of(box.low - Vec2::Constant(within));
    const auto [x1, y1] = cell_of(box.high + Vec2::Constant(within));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (const std::int32_t index : cells_[y * columns_ + x]) {
          const Box2& own = boxes_[static_cast<std::size_t>(index)];
          if (!own.comes_within(box, within)) continue;
          // Visited in the first cell that it shares with the given box.
          const auto [first_x, first_y] = cell_of(own.low);
          if (x != std::max(x0, first_x) || y != std::max(y0, first_y)) continue;
          if (!visit(index)) return false;
        }
    return true;
  }

  /// Calls visit(index) for every box within `within` of a segment, only in the cells that it
  /// passes, row by row; also for some farther boxes, and for some more than once.
  template <class Visit>
  void for_each_near(const Vec2& a, const Vec2& b, double within, Visit&& visit) const {
    LMDBENCH_EXPECTS(within >= 0.0, "a tolerance that is negative or not a number");
    Box2 all;
    all.add(a);
    all.add(b);
    const int first = cell_of(all.low - Vec2::Constant(within)).second;
    const int last = cell_of(all.high + Vec2::Constant(within)).second;
    const double rise = b[1] - a[1];
    for (int y = first; y <= last; ++y) {
      // The part of the segment in this row; the first and last rows extend outwards without end.
      Box2 part = all;
      const double bottom = bounds_.low[1] + y / cells_per_metre_[1] - within;
      const double top = bounds_.low[1] + (y + 1) / cells_per_metre_[1] + within;
      if (rise != 0.0) {
        const auto clipped = [&](double height) { return std::clamp((height - a[1]) / rise, 0.0, 1.0); };
        const double at_bottom = clipped(y > 0 ? bottom : all.low[1]);
        const double at_top = clipped(y + 1 < rows_ ? top : all.high[1]);
        const double x0 = a[0] + at_bottom * (b[0] - a[0]), x1 = a[0] + at_top * (b[0] - a[0]);
        part.low[0] = std::min(x0, x1);
        part.high[0] = std::max(x0, x1);
      }
      const int left = cell_of(part.low - Vec2::Constant(within)).first;
      const int right = cell_of(part.high + Vec2::Constant(within)).first;
      for (int x = left; x <= right; ++x)
        for (const std::int32_t index : cells_[y * columns_ + x])
          if (boxes_[static_cast<std::size_t>(index)].comes_within(part, within)) visit(index);
    }
  }

 private:
  /// Column and row of the cell that holds a point, or of the nearest cell.
  std::pair<int, int> cell_of(const Vec2& x) const {
    const Vec2 at = (x - bounds_.low).cwiseProduct(cells_per_metre_);
    return {static_cast<int>(std::clamp(at[0], 0.0, columns_ - 1.0)),
            static_cast<int>(std::clamp(at[1], 0.0, rows_ - 1.0))};
  }

  std::vector<Box2> boxes_;
  Box2 bounds_;
  Vec2 cells_per_metre_ = Vec2::Zero();
  int columns_ = 1, rows_ = 1;
  CsrRows cells_;
};

}  // namespace lmdbench
