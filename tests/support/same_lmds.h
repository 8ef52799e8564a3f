// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace lmdbench::testing {

/// Expects LMDs of the same features in the same order, whose distances differ by at most `within`.
inline void expect_like_lmds(const LmdSet& found, const LmdSet& expected, double within,
                             const std::string& where = "") {
  ASSERT_EQ(found.size(), expected.size()) << where;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(same_feature_pair(found[i], expected[i])) << where << ", LMD " << i;
    EXPECT_NEAR(found[i].distance, expected[i].distance, within) << where << ", LMD " << i;
  }
}

/// Expects LMDs of the same features in the same order, all with the same bits; directions where
/// there are any.
inline void expect_same_lmds(const LmdSet& found, const LmdSet& expected, const std::string& where = "") {
  expect_like_lmds(found, expected, 0.0, where);
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    EXPECT_EQ(found[i].point_moving, expected[i].point_moving) << where << ", LMD " << i;
    EXPECT_EQ(found[i].point_fixed, expected[i].point_fixed) << where << ", LMD " << i;
    EXPECT_EQ(found[i].triangle_moving, expected[i].triangle_moving) << where << ", LMD " << i;
    EXPECT_EQ(found[i].triangle_fixed, expected[i].triangle_fixed) << where << ", LMD " << i;
    if (found[i].direction.allFinite() || expected[i].direction.allFinite()) {
      EXPECT_EQ(found[i].direction, expected[i].direction) << where << ", LMD " << i;
    }
  }
}

}  // namespace lmdbench::testing
