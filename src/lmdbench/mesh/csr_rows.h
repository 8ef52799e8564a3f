// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace lmdbench {

/// Lists of indices as compressed sparse rows: row i is items[offsets[i]] .. items[offsets[i + 1]).
class CsrRows {
 public:
  CsrRows() = default;

  /// @param offsets one more than rows, ascending, from 0 to the number of items
  CsrRows(std::vector<std::int32_t> offsets, std::vector<std::int32_t> items)
      : offsets_(std::move(offsets)), items_(std::move(items)) {
    LMDBENCH_EXPECTS(!offsets_.empty() && offsets_.front() == 0 && std::ranges::is_sorted(offsets_) &&
                         static_cast<std::size_t>(offsets_.back()) == items_.size(),
                     "offsets that were not summed up, or are one short");
  }

  /// Groups `pairs` of (row, item) into `row_count` rows; items of a row keep the order of `pairs`.
  CsrRows(std::int32_t row_count, std::span<const std::pair<std::int32_t, std::int32_t>> pairs)
      : offsets_(static_cast<std::size_t>(row_count) + 1, 0), items_(pairs.size()) {
    for (const auto& [row, item] : pairs) ++offsets_[static_cast<std::size_t>(row) + 1];
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    std::vector<std::int32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (const auto& [row, item] : pairs)
      items_[static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++)] = item;
  }

  std::span<const std::int32_t> operator[](std::int32_t row) const {
    LMDBENCH_EXPECTS(row >= 0 && row < row_count(),
                     "an index of another kind of feature, or of another mesh");
    const auto begin = static_cast<std::size_t>(offsets_[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(offsets_[static_cast<std::size_t>(row) + 1]);
    return {items_.data() + begin, end - begin};
  }
  std::int32_t row_count() const { return static_cast<std::int32_t>(offsets_.size()) - 1; }
  /// Memory that the rows take.
  std::size_t bytes() const { return (offsets_.size() + items_.size()) * sizeof(std::int32_t); }

 private:
  std::vector<std::int32_t> offsets_{0};
  std::vector<std::int32_t> items_;
};

}  // namespace lmdbench
