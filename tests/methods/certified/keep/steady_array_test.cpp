// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/keep/steady_array.h>

#include <gtest/gtest.h>

#include <vector>

namespace lmdbench {
namespace {

TEST(SteadyArray, EntriesStayWhereTheyAre) {
  constexpr int ENTRIES = 2000;
  SteadyArray<int> array;
  EXPECT_EQ(array.size(), 0u);
  std::vector<const int*> places;
  for (int i = 0; i < ENTRIES; ++i) {
    array.push_back(i);
    ASSERT_EQ(array.size(), static_cast<std::size_t>(i) + 1);
    ASSERT_LE(array.size(), array.capacity());
    places.push_back(&array[static_cast<std::size_t>(i)]);
  }
  for (std::size_t i = 0; i < ENTRIES; ++i) {
    EXPECT_EQ(array[i], static_cast<int>(i));
    EXPECT_EQ(&array[i], places[i]);
  }
}

}  // namespace
}  // namespace lmdbench
