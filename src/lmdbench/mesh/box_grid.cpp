// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/box_grid.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

/// Most cells of a box on average. Boxes of long triangles round one vertex would each cover a good
/// part of all cells; then the cells are larger.
constexpr double MOST_CELLS_A_BOX = 16.0;

}  // namespace

BoxGrid::BoxGrid(std::vector<Box2> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) {
    // One empty cell, for a region without boxes.
    bounds_.add(Vec2::Zero());
    cells_ = CsrRows({0, 0}, {});
    return;
  }
  for (const Box2& box : boxes_) {
    bounds_.add(box.low);
    bounds_.add(box.high);
  }
  const Vec2 size = bounds_.high - bounds_.low;
  const auto count = static_cast<double>(boxes_.size());
  const double spacing = std::sqrt(std::max(1e-300, size[0] * size[1]) / count);
  const auto cells_of = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, count));
  };
  columns_ = cells_of(size[0]);
  rows_ = cells_of(size[1]);
  const auto measure_cells = [&] {
    cells_per_metre_ = Vec2(size[0] > 0.0 ? columns_ / size[0] : 0.0, size[1] > 0.0 ? rows_ / size[1] : 0.0);
  };
  const auto covered_cells = [&] {
    double sum = 0.0;
    for (const Box2& box : boxes_) {
      const auto [x0, y0] = cell_of(box.low);
      const auto [x1, y1] = cell_of(box.high);
      sum += (x1 - x0 + 1.0) * (y1 - y0 + 1.0);
    }
    return sum;
  };
  for (measure_cells(); covered_cells() > MOST_CELLS_A_BOX * count; measure_cells()) {
    columns_ = (columns_ + 1) / 2;
    rows_ = (rows_ + 1) / 2;
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto [x0, y0] = cell_of(boxes_[i].low);
    const auto [x1, y1] = cell_of(boxes_[i].high);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) pairs.emplace_back(y * columns_ + x, static_cast<std::int32_t>(i));
  }
  cells_ = CsrRows(columns_ * rows_, pairs);
}

}  // namespace lmdbench
