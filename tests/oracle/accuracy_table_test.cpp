// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <judge/accuracy_table.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <cctype>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace lmdbench::testing {
namespace {

std::string published(const char* path) {
  return read_text(std::string(LMDBENCH_SOURCE_DIR) + "/" + path);
}

const std::vector<AccuracyRow>& published_rows() {
  static const std::vector<AccuracyRow> ROWS = judge_accuracy(PUBLISHED_PAIRS);
  return ROWS;
}

TEST(AccuracyTable, IsTheOneThatIsPublished) {
  // Our kernel has no wrong answer in any family; others have some in families made for that.
  int wrong_fcl = 0;
  for (const AccuracyRow& row : published_rows()) {
    EXPECT_EQ(row.cells[0].wrong, 0) << row.family;
    EXPECT_EQ(row.cells[0].contact_mistakes, 0) << row.family;
    wrong_fcl += row.cells[1].wrong;
  }
  EXPECT_GT(wrong_fcl, 100) << "the families no longer show the published defects";
  const std::string table = accuracy_markdown(published_rows(), PUBLISHED_PAIRS);
  EXPECT_NE(published(PUBLISHED_TABLE).find(table), std::string::npos)
      << PUBLISHED_TABLE << " is out of date (remedy: lmdbench-judge accuracy > " << PUBLISHED_TABLE
      << "); the table is now\n"
      << table;
}

/// A cell of a published table: wrong answers, gross errors, false contacts; largest error.
struct PublishedCell {
  int wrong = 0, gross = 0, false_contacts = 0;
  double worst = 0.0;
};

std::vector<PublishedCell> parsed(const std::string& row) {
  std::istringstream text(row);
  std::string field;
  std::getline(text, field, '|');  // before the first bar
  std::getline(text, field, '|');  // the family
  std::vector<PublishedCell> cells;
  while (std::getline(text, field, '|')) {
    PublishedCell cell;
    for (char& c : field) c = std::isdigit(static_cast<unsigned char>(c)) != 0 ? c : ' ';
    std::istringstream(field) >> cell.wrong >> cell.gross >> cell.false_contacts;
    std::getline(text, field, '|');
    cell.worst = field.find("not") != std::string::npos ? std::numeric_limits<double>::infinity()
                                                        : std::strtod(field.c_str(), nullptr);
    cells.push_back(cell);
  }
  return cells;
}

std::string row_of(const std::string& text, const std::string& family) {
  const std::size_t begin = text.find("| " + family + " |");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

TEST(AccuracyTable, OfAMillionPairsHoldsTheBeginningOfEachFamily) {
  // The short table uses the first pairs of the long one: its wrong answers are wrong there too.
  const std::string million = published(MILLION_TABLE);
  const std::string brief = accuracy_markdown(published_rows(), PUBLISHED_PAIRS);
  ASSERT_NE(million.find(brief.substr(0, brief.find('\n') + 1)), std::string::npos) << "other kernels";
  for (const AccuracyRow& row : published_rows()) {
    const std::vector<PublishedCell> few = parsed(accuracy_markdown(row));
    const std::vector<PublishedCell> many = parsed(row_of(million, row.family));
    ASSERT_EQ(many.size(), row.cells.size()) << row.family << " is missing";
    for (std::size_t k = 0; k < many.size(); ++k) {
      EXPECT_GE(many[k].wrong, few[k].wrong) << row.family << ", kernel " << k;
      EXPECT_GE(many[k].gross, few[k].gross) << row.family << ", kernel " << k;
      EXPECT_GE(many[k].false_contacts, few[k].false_contacts) << row.family << ", kernel " << k;
      EXPECT_GE(many[k].worst, few[k].worst) << row.family << ", kernel " << k;
      EXPECT_LE(many[k].wrong, MILLION_PAIRS - PUBLISHED_PAIRS + few[k].wrong) << row.family;
    }
    EXPECT_EQ(many[0].wrong, 0) << row.family;
  }
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
