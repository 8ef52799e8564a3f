// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/errors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

/// Against the table of Garwood (1936), 95 %.
TEST(Events, LimitsAreGarwoods) {
  struct Row {
    std::int64_t count;
    double low, high;
  };
  for (const Row& row : {Row{0, 0.0, 3.689}, Row{1, 0.0253, 5.572}, Row{2, 0.2422, 7.225},
                         Row{5, 1.623, 11.668}, Row{10, 4.795, 18.390}, Row{100, 81.364, 121.627}}) {
    const Events events = count_events(row.count, 2.0);
    EXPECT_EQ(events.count, static_cast<double>(row.count));
    EXPECT_NEAR(2.0 * events.low, row.low, 1e-3 * (1.0 + row.low)) << row.count;
    EXPECT_NEAR(2.0 * events.high, row.high, 1e-3 * row.high) << row.count;
  }
}

TEST(Events, FewerThanTenHaveNoRate) {
  EXPECT_TRUE(std::isnan(count_events(9, 2.0).per_second));
  EXPECT_EQ(count_events(10, 2.0).per_second, 5.0);
  EXPECT_TRUE(std::isnan(count_events(0, 2.0).per_second));
}

TEST(Events, NoTimeIsNoCount) {
  const Events nothing = count_events(0, 0.0);
  for (const double value : {nothing.count, nothing.per_second, nothing.low, nothing.high})
    EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(events_text(nothing, 0.0, " in contact"), "-");
}

TEST(Events, TextHasCountTimeAndInterval) {
  EXPECT_EQ(events_text(count_events(2, 0.5), 0.5, " in contact"),
            "2 in 0.5 s in contact (95 %: 0.484 to 14.4 a second)");
  EXPECT_EQ(events_text(count_events(100, 2.0), 2.0, ""),
            "100 in 2 s, 50 a second (95 %: 40.7 to 60.8 a second)");
}

}  // namespace
}  // namespace lmdbench
