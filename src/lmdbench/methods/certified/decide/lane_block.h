// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <cstddef>

namespace lmdbench::kernel {

/// Pairs that a stage of the batch takes at a time: the widest vectors hold eight doubles, narrower
/// ones take the block in pieces.
inline constexpr std::size_t MAX_LANES = 8;

/// Corners of MAX_LANES triangle pairs, one lane a pair.
struct LaneBlock {
  alignas(64) double a[3][3][MAX_LANES];  ///< corner, axis, lane
  alignas(64) double b[3][3][MAX_LANES];
};

/// Copies a pair to a lane.
inline void load(LaneBlock& block, std::size_t lane, const Triangle& a, const Triangle& b) {
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      block.a[k][axis][lane] = a[k][axis];
      block.b[k][axis][lane] = b[k][axis];
    }
  }
}

/// Gaps, and the unit vectors along which they are measured, one lane a pair.
struct LaneGap {
  alignas(64) double gap[MAX_LANES];
  alignas(64) double axis[3][MAX_LANES];
};

/// Middle and length of the segment that crossing triangles share.
struct LaneCrossing {
  alignas(64) double middle[3][MAX_LANES];
  alignas(64) double length[MAX_LANES];
};

}  // namespace lmdbench::kernel
