// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

TEST(ParallelRanges, CoverEveryIndexOnce) {
  for (const std::size_t count : {0u, 1u, 5u, 1000u}) {
    for (const std::size_t grain : {1u, 7u, 2000u}) {
      std::vector<int> visits(count, 0);
      parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << "grain " << grain;
    }
  }
}

TEST(ParallelFor, CallsEveryIndexOnceAndWaits) {
  std::vector<int> visits(777, 0);
  parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
  EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), 0), 777);
}

TEST(ParallelInvoke, DoesBoth) {
  int first = 0, second = 0;
  parallel_invoke([&] { first = 1; }, [&] { second = 2; });
  EXPECT_EQ(first + second, 3);
}

TEST(PerThread, IsMadeOnceAThreadAndStays) {
  std::atomic<int> made{0};
  PerThread<std::vector<int>> lists([&] {
    ++made;
    return std::vector<int>{};
  });
  std::mutex mutex;
  std::size_t noted = 0;
  parallel_for(1000, [&](std::size_t i) {
    std::vector<int>& own = lists.local();
    own.push_back(static_cast<int>(i));
    const std::lock_guard lock(mutex);
    noted += own.back() == static_cast<int>(i) ? 1 : 0;
  });
  EXPECT_EQ(noted, 1000u);
  EXPECT_GE(made, 1);
  EXPECT_LE(made, 64);
}

}  // namespace
}  // namespace lmdbench
