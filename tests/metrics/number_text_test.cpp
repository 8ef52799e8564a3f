// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/number_text.h>

#include <gtest/gtest.h>

#include <limits>

namespace lmdbench {
namespace {

TEST(NumberText, HasThreeDigitsOrAllWholeOnes) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(1.2345e-7), "1.23e-07");
  EXPECT_EQ(number_text(999.4), "999");
  EXPECT_EQ(number_text(999.6), "1000");
  EXPECT_EQ(number_text(1201.0), "1201");
  EXPECT_EQ(number_text(-123456.7), "-123457");
  EXPECT_EQ(number_text(1.5e12), "1.5e+12");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(NumberText, AShareBelowOneDoesNotReadAsOne) {
  EXPECT_EQ(share_text(1.0, 100.0), "100");
  EXPECT_EQ(share_text(0.885, 100.0), "88.5");
  EXPECT_EQ(share_text(0.9998, 100.0), "99.98");
  EXPECT_EQ(share_text(0.9999996, 1.0), "0.9999996");
  EXPECT_EQ(share_text(0.0, 100.0), "0");
  EXPECT_EQ(share_text(std::numeric_limits<double>::quiet_NaN(), 100.0), "-");
}

}  // namespace
}  // namespace lmdbench
