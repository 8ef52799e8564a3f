// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/plain_name.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

TEST(PlainName, KeepsWhatItMayAndStaysShort) {
  EXPECT_EQ(plain_name("peg_2.1-a", "_-."), "peg_2.1-a");
  EXPECT_EQ(plain_name("peg 2.1", "_"), "peg-2-1");
  EXPECT_EQ(plain_name("_-.x", "_-."), "x");
  EXPECT_EQ(plain_name("---", "_-"), "");
}

/// Names in other alphabets have nothing that stays: a hash tells them apart.
TEST(PlainName, OfOtherAlphabetsStayTwo) {
  const std::string one = plain_name("\u7532", "_"), other = plain_name("\u4e59", "_");
  EXPECT_EQ(one.size(), 6u);
  EXPECT_NE(one, other);
  EXPECT_EQ(one, plain_name("\u7532", "_"));
  EXPECT_TRUE(plain_name("p\u00e9g", "_").starts_with("pg-"));
}

TEST(ShellWord, IsQuotedWhereItMustBe) {
  EXPECT_EQ(shell_word("my/p\u00e9g-1.off"), "my/p\u00e9g-1.off");
  EXPECT_EQ(shell_word("my parts/$a.off"), "'my parts/$a.off'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace lmdbench
