// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

constexpr double NOT_SET = std::numeric_limits<double>::quiet_NaN();

TEST(Statistics, QuantilesInterpolateAsNumpyDoes) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_DOUBLE_EQ(quantile({10, 20, 30, 40, 50}, 0.9), 46.0);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.99), 7.0);
}

TEST(Statistics, UnsetValuesDoNotCount) {
  EXPECT_DOUBLE_EQ(median({NOT_SET, 1, 3, NOT_SET}), 2.0);
  EXPECT_DOUBLE_EQ(mean({NOT_SET, 1, 3}), 2.0);
  EXPECT_DOUBLE_EQ(maximum({-5, NOT_SET, -3}), -3.0);
}

TEST(Statistics, NothingLeftIsUnset) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(mean({NOT_SET})));
  EXPECT_TRUE(std::isnan(maximum({})));
}

TEST(Statistics, InfinitiesDoNotBecomeNaN) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(quantile({1, infinity, infinity, infinity}, 0.9), infinity);
}

}  // namespace
}  // namespace lmdbench
