// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/accuracy_table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace lmdbench::testing {
namespace {

TEST(AccuracyTable, IsTheOneThatIsPublished) {
  const auto rows = judge_accuracy(PUBLISHED_PAIRS);
  // The claim first: no wrong answer of ours in any family, and others are wrong where the families say so.
  int wrong_fcl = 0;
  for (const AccuracyRow& row : rows) {
    EXPECT_EQ(row.cells[0].wrong, 0) << row.family;
    EXPECT_EQ(row.cells[1].wrong, 0) << row.family;
    wrong_fcl += row.cells[2].wrong;
  }
  EXPECT_GT(wrong_fcl, 100) << "the families no longer show the published defects";
  std::ifstream file(std::string(LMDBENCH_SOURCE_DIR) + "/" + PUBLISHED_TABLE);
  ASSERT_TRUE(file) << PUBLISHED_TABLE << " is missing";
  std::ostringstream published;
  published << file.rdbuf();
  const std::string table = accuracy_markdown(rows, PUBLISHED_PAIRS);
  EXPECT_NE(published.str().find(table), std::string::npos)
      << PUBLISHED_TABLE << " is out of date (remedy: lmdbench_triangle_accuracy > " << PUBLISHED_TABLE
      << "); the table is now\n"
      << table;
}

}  // namespace
}  // namespace lmdbench::testing
