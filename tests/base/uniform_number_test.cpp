// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

TEST(UniformNumber, IsTheSameOnEveryPlatform) {
  std::mt19937_64 generator(5489);  // The standard fixes its 10000th number.
  for (int i = 1; i < 10000; ++i) generator();
  EXPECT_EQ(uniform_number(generator),
            static_cast<double>(9981545732273789042ULL >> 11) / 9007199254740992.0);
}

}  // namespace
}  // namespace lmdbench
