// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/decide/triangle_contact_batch.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Vectors of unknown length cannot be members of structures.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/decide/triangle_contact_batch.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/decide/lane_crossing-inl.h>
#include <lmdbench/methods/certified/decide/lane_gap-inl.h>

#include <hwy/highway.h>

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(clear_gap);
HWY_EXPORT(crossing);

namespace {

using kernel::LaneBlock;
using kernel::LaneCrossing;
using kernel::LaneGap;
using kernel::MAX_LANES;

/// Calls visit(begin, count, block) for all pairs, MAX_LANES at a time; spare lanes get the last.
template <class Visit>
void for_each_block(std::span<const Triangle> a, std::span<const Triangle> b, Visit visit) {
  LaneBlock block;
  for (std::size_t begin = 0; begin < a.size(); begin += MAX_LANES) {
    const std::size_t count = std::min(MAX_LANES, a.size() - begin);
    for (std::size_t lane = 0; lane < MAX_LANES; ++lane) {
      const std::size_t pair = begin + std::min(lane, count - 1);
      load(block, lane, a[pair], b[pair]);
    }
    visit(begin, count, block);
  }
}

}  // namespace

void find_clear_crossings(std::span<const Triangle> a, std::span<const Triangle> b,
                          std::span<ClearCrossing> results) {
  LMDBENCH_ALWAYS(a.size() == b.size() && a.size() == results.size(), "parallel arrays of unlike lengths");
  LaneCrossing lanes;
  for_each_block(a, b, [&](std::size_t begin, std::size_t count, const LaneBlock& block) {
    const std::uint32_t crosses = HWY_DYNAMIC_DISPATCH(crossing)(block, lanes);
    for (std::size_t lane = 0; lane < count; ++lane) {
      ClearCrossing& result = results[begin + lane];
      result.middle = {lanes.middle[0][lane], lanes.middle[1][lane], lanes.middle[2][lane]};
      result.length = ((crosses >> lane) & 1U) != 0 ? lanes.length[lane] : 0.0;
    }
  });
}

void find_clear_gaps(std::span<const Triangle> a, std::span<const Triangle> b, std::span<ClearGap> results) {
  LMDBENCH_ALWAYS(a.size() == b.size() && a.size() == results.size(), "parallel arrays of unlike lengths");
  LaneGap lanes;
  for_each_block(a, b, [&](std::size_t begin, std::size_t count, const LaneBlock& block) {
    HWY_DYNAMIC_DISPATCH(clear_gap)(block, lanes);
    for (std::size_t lane = 0; lane < count; ++lane)
      results[begin + lane] = {lanes.gap[lane],
                               {lanes.axis[0][lane], lanes.axis[1][lane], lanes.axis[2][lane]}};
  });
}

}  // namespace lmdbench

#endif  // HWY_ONCE
