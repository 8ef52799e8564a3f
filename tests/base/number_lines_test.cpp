// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

using Lines = std::vector<std::pair<std::string, std::vector<double>>>;

Lines lines_of(const std::string& text) {
  Lines lines;
  for_each_number_line(text, "some.xyz", "write numbers",
                       [&](const std::string& place, std::span<const double> numbers) {
                         lines.emplace_back(place, std::vector<double>(numbers.begin(), numbers.end()));
                       });
  return lines;
}

TEST(NumberLines, BlanksAndCommasSeparateAndCommentsAreLeftOut) {
  EXPECT_THAT(lines_of("# x y\n1 -2e-3,3\r\n\n   # nothing\n4.5 # five\n"),
              ElementsAre(Pair("line 2", ElementsAre(1.0, -2e-3, 3.0)), Pair("line 5", ElementsAre(4.5))));
  EXPECT_TRUE(lines_of("").empty());
  EXPECT_THAT(lines_of("\xEF\xBB\xBF"
                       "1 2\n"),
              ElementsAre(Pair("line 1", ElementsAre(1.0, 2.0))))
      << "a byte order mark";
}

TEST(NumberLines, WhatIsNoFiniteNumberIsNamedWithItsLine) {
  for (const std::string word : {"1.5x", "nan", "inf", "1e999", "--1"}) {
    EXPECT_THAT(testing::message_of<InputError>([&] { lines_of("1 2\n3 " + word + "\n"); }),
                AllOf(HasSubstr("some.xyz"), HasSubstr("line 2"),
                      HasSubstr("\"" + word + "\" is no finite number"), HasSubstr("write numbers")));
  }
}

TEST(NumberLines, AnEmptyCellIsNamedWithItsLine) {
  for (const std::string line : {"0,0.1,,0.2", ",1", "1,2,", "1, \t,2", ",\r"})
    EXPECT_THAT(testing::message_of<InputError>([&] { lines_of("1,2\n" + line + "\n"); }),
                AllOf(HasSubstr("line 2"), HasSubstr("nothing before or behind a comma")))
        << line;
}

}  // namespace
}  // namespace lmdbench
