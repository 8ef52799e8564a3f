// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <support/timing.h>

#include <cmath>
#include <string>
#include <vector>

namespace lmdbench::experiments {
namespace {

TEST(TimeInterleaved, RunsEveryTaskAtEveryPoseInRotatingOrder) {
  std::vector<std::string> order;
  const auto task = [&order](const std::string& name) {
    return TimedTask{name,
                     [&order, name](std::size_t pose) { order.push_back(name + std::to_string(pose)); }};
  };
  const auto seconds = time_interleaved({task("a"), task("b")}, 2, 2);
  const std::vector<std::string> expected = {"a0", "b0", "a1", "b1",   // not recorded
                                             "a0", "b0", "b1", "a1",   // first repetition
                                             "b0", "a0", "a1", "b1"};  // second
  EXPECT_EQ(order, expected);
  ASSERT_EQ(seconds.size(), 2U);
  EXPECT_EQ(seconds[0].size(), 2U);
  EXPECT_GE(seconds[0][0], 0.0);
}

TEST(TimeInterleaved, PreparesBeforeEachRunAndDoesNotTimeThat) {
  std::string order;
  const TimedTask task{"a", [&](std::size_t) { order += "r"; },
                       [&](std::size_t) {
                         order += "p";
                         const double until = thread_seconds() + 0.005;
                         while (thread_seconds() < until) {
                         }
                       }};
  const auto seconds = time_interleaved({task}, 1, 3);
  EXPECT_EQ(order, "prprprpr");
  EXPECT_LT(seconds[0][0], 0.005);
}

TEST(LogSlope, OfAPowerIsItsExponent) {
  EXPECT_NEAR(log_slope({1.0, 10.0, 100.0}, {3.0, 3.0 * std::sqrt(10.0), 30.0}), 0.5, 1e-12);
  EXPECT_NEAR(log_slope({10.0, 1000.0}, {2.0, 2.0}), 0.0, 1e-12);
}

}  // namespace
}  // namespace lmdbench::experiments
