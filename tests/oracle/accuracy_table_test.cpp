// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <judge/accuracy_table.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <cctype>
#include <string>
#include <vector>

namespace lmdbench::testing {
namespace {

std::string published(const char* path) {
  return read_text(std::string(LMDBENCH_SOURCE_DIR) + "/" + path);
}

TEST(AccuracyTable, IsTheOneThatIsPublished) {
  // Our kernel has no wrong answer in any family; others have some in families made for that.
  const std::vector<AccuracyRow> rows = judge_accuracy(PUBLISHED_PAIRS);
  int wrong_fcl = 0;
  for (const AccuracyRow& row : rows) {
    EXPECT_EQ(row.cells[0].wrong, 0) << row.family;
    EXPECT_EQ(row.cells[0].contact_mistakes, 0) << row.family;
    wrong_fcl += row.cells[1].wrong;
  }
  EXPECT_GT(wrong_fcl, 100) << "the families no longer show the published defects";
  const std::string table = accuracy_markdown(rows, PUBLISHED_PAIRS);
  EXPECT_NE(published(PUBLISHED_TABLE).find(table), std::string::npos)
      << PUBLISHED_TABLE << " is out of date (remedy: lmdbench-judge accuracy > " << PUBLISHED_TABLE
      << "); the table is now\n"
      << table;
  EXPECT_NE(published(MILLION_TABLE).find(table.substr(0, table.find('\n') + 1)), std::string::npos)
      << MILLION_TABLE << " is of other kernels";
  EXPECT_NE(published(MILLION_TABLE).find(fmt::format("| **all, {} pairs** |", rows.size() * MILLION_PAIRS)),
            std::string::npos)
      << MILLION_TABLE << " is of other pairs";
}

class MillionTable : public ::testing::TestWithParam<TriangleFamily> {};

TEST_P(MillionTable, HasThisRow) {
  const AccuracyRow row = judge_family(GetParam(), MILLION_PAIRS);
  EXPECT_EQ(row.cells[0].wrong, 0);
  EXPECT_EQ(row.cells[0].contact_mistakes, 0);
  EXPECT_NE(published(MILLION_TABLE).find(accuracy_markdown(row)), std::string::npos)
      << MILLION_TABLE << " is out of date (remedy: lmdbench-judge accuracy --million > " << MILLION_TABLE
      << "); the row is now\n"
      << accuracy_markdown(row);
}

INSTANTIATE_TEST_SUITE_P(All, MillionTable,
                         ::testing::ValuesIn(triangle_families().begin(), triangle_families().end()),
                         [](const auto& parameter) {
                           std::string name(parameter.param.name);
                           std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace lmdbench::testing
