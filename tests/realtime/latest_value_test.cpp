// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/latest_value.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace lmdbench {
namespace {

TEST(LatestValue, NothingIsFetchedBeforeAnythingIsPublished) {
  LatestValue<int> value(7);
  EXPECT_FALSE(value.fetch());
  EXPECT_EQ(value.value(), 7);
}

TEST(LatestValue, TheLatestIsFetchedOnce) {
  LatestValue<int> value;
  for (const int number : {1, 2, 3}) {
    value.slot() = number;
    value.publish();
  }
  EXPECT_TRUE(value.fetch());
  EXPECT_EQ(value.value(), 3);
  EXPECT_FALSE(value.fetch());
  EXPECT_EQ(value.value(), 3) << "what was fetched stays";
  value.slot() = 4;
  EXPECT_FALSE(value.fetch()) << "not published yet";
  value.publish();
  EXPECT_TRUE(value.fetch());
  EXPECT_EQ(value.value(), 4);
  value.slot() = 5;
  value.publish();
  value.slot() = 6;
  EXPECT_TRUE(value.fetch());
  EXPECT_EQ(value.value(), 5) << "not what is being written";
}

/// A value that tells whether it is whole.
struct Wide {
  std::array<std::uint64_t, 64> words{};
};

TEST(LatestValue, TwoThreadsNeverSeeAValueInPartsNorAnEarlierOne) {
  constexpr std::uint64_t LAST = 50000;
  LatestValue<Wide> value;
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= LAST; ++n) {
      value.slot().words.fill(n);
      value.publish();
    }
  });
  std::uint64_t seen = 0;
  bool whole = true, in_order = true;
  while (seen < LAST) {
    if (!value.fetch()) continue;
    const Wide& read = value.value();
    in_order = in_order && read.words.front() > seen;
    seen = read.words.front();
    for (const std::uint64_t word : read.words) whole = whole && word == seen;
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace lmdbench
