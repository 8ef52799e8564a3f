// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>

#include <gtest/gtest.h>

#include <limits>

namespace lmdbench {
namespace {

TEST(SignificantDigits, AreKept) {
  EXPECT_EQ(to_significant_digits(0.0123456, 3), 0.0123);
  EXPECT_EQ(to_significant_digits(-98765.0, 2), -99000.0);
  EXPECT_EQ(to_significant_digits(0.0, 4), 0.0);
  EXPECT_EQ(to_significant_digits(0.1 + 0.2, 12), 0.3);
}

TEST(SignificantDigits, OfTheSmallestAndLargestNumbersAreNumbers) {
  EXPECT_EQ(to_significant_digits(1.2345e-310, 2), 1.2e-310);
  EXPECT_EQ(to_significant_digits(5e-324, 4), 5e-324);
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(to_significant_digits(largest, 2), largest);
}

}  // namespace
}  // namespace lmdbench
