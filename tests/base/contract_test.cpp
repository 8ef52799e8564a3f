// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

TEST(Contract, OneThatAlwaysHoldsSaysWhatIsBrokenAndWhy) {
  const int corners = 4;
  LMDBENCH_ALWAYS(corners > 0, "never read");
  EXPECT_DEATH(
      LMDBENCH_ALWAYS(corners == 3, "a quadrilateral that was not cut"),
      "contract broken: corners == 3 \\(.*contract_test.cpp:[0-9]+\\): a quadrilateral that was not cut");
}

TEST(Contract, IsCheckedWhereTheBuildLooksForDefectsAndNeverEvaluatedElsewhere) {
  int asked = 0;
  const auto ask = [&] {
    ++asked;
    return true;
  };
  LMDBENCH_EXPECTS(ask(), "never read");
  LMDBENCH_ENSURES(ask(), "never read");
#ifdef LMDBENCH_CONTRACTS
  EXPECT_EQ(asked, 2);
  EXPECT_DEATH(LMDBENCH_EXPECTS(asked == 0, "asked before"), "contract broken: asked == 0 .*: asked before");
#else
  EXPECT_EQ(asked, 0);
#endif
}

}  // namespace
}  // namespace lmdbench
