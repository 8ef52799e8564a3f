// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <thread>
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
  EXPECT_EQ(visits, std::vector<int>(777, 1));
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
  std::map<std::thread::id, std::set<const void*>> of_threads;
  parallel_for(1000, [&](std::size_t i) {
    std::vector<int>& own = lists.local();
    own.push_back(static_cast<int>(i));
    const std::lock_guard lock(mutex);
    of_threads[std::this_thread::get_id()].insert(&own);
  });
  EXPECT_EQ(static_cast<std::size_t>(made), of_threads.size());
  for (const auto& [thread, own] : of_threads) EXPECT_EQ(own.size(), 1u);
}

}  // namespace
}  // namespace lmdbench
