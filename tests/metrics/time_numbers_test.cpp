// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/times.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

/// Four frames at 1 kHz, a search in frames 0 and 2; the first repetition warms up.
MethodRecord record() {
  MethodRecord made;
  for (const std::int64_t tracked : {0, 2, 4, 0}) made.frames.emplace_back().tracked_count = tracked;
  for (const std::int64_t frame : {0, 2}) made.searches.emplace_back().frame = frame;
  RepetitionTimes warm_up{{9, 9, 9, 9}, {}, {}, {9, 9}, {9, 9}, {9, 9}};
  RepetitionTimes measured{{1e-6, 2e-6, 4e-6, 1e-6}, {}, {}, {1e-5, 3e-5}, {1e-5, UNSET}, {UNSET, UNSET}};
  made.repetitions = {warm_up, measured};
  return made;
}

TEST(TimeNumbers, AreOfTheFramesThatCountAndTheirShareOfTheSearches) {
  const TimeNumbers all = measure_times(record(), {true, true, true, true}, 1000.0);
  EXPECT_NEAR(all.processor_share, (8e-6 + 5e-5) / 4e-3, 1e-12);
  EXPECT_NEAR(all.search_share, 5e-5 / (8e-6 + 5e-5), 1e-9);
  EXPECT_NEAR(all.local_update_mean_s, 2e-6, 1e-15);
  EXPECT_NEAR(all.local_update_empty_median_s, 1e-6, 1e-15);
  EXPECT_NEAR(all.local_update_filled_median_s, 3e-6, 1e-15);
  EXPECT_NEAR(all.local_update_per_tracked_s, 6e-6 / 6.0, 1e-15);
  const TimeNumbers first = measure_times(record(), {true, true, false, false}, 1000.0);
  EXPECT_NEAR(first.processor_share, (3e-6 + 2e-5) / 2e-3, 1e-12);
}

TEST(TimeNumbers, AreUnsetWhereNothingCounts) {
  EXPECT_TRUE(std::isnan(measure_times(record(), {false, false, false, false}, 1000.0).processor_share));
}

TEST(ClockOverhead, IsSomethingButLessThanAFrame) {
  const double overhead = clock_overhead();
  EXPECT_GE(overhead, 0.0);
  EXPECT_LT(overhead, 1e-4);
}

}  // namespace
}  // namespace lmdbench
