// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <array>
#include <cstdint>

namespace lmdbench {

/// The lanes whose bit is set in a mask, in ascending order; the rest of `lane` is zero.
struct LaneList {
  std::array<std::uint8_t, WIDE_WIDTH> lane{};
  std::uint8_t count = 0;
};

/// One list a mask: survivors are appended without a branch.
inline constexpr std::array<LaneList, 1u << WIDE_WIDTH> LANE_LISTS = [] {
  std::array<LaneList, 1u << WIDE_WIDTH> lists{};
  for (std::uint32_t mask = 0; mask < lists.size(); ++mask)
    for (std::uint8_t lane = 0; lane < WIDE_WIDTH; ++lane)
      if ((mask >> lane & 1u) != 0) lists[mask].lane[lists[mask].count++] = lane;
  return lists;
}();

}  // namespace lmdbench
