// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/printable_text.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace lmdbench {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PrintableText, KeepsPlainTextAndEscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("a b\\n \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80"),
            "a b\\n \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(printable(std::string("\x1b[31m\0\n\t\x7f", 9)), "\\x1b[31m\\x00\\x0a\\x09\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"), "\\xc2\\x9b") << "the one-character form of ESC [";
  EXPECT_EQ(printable("\xE2\x80\xAE"), "\\xe2\\x80\\xae") << "turns the direction of writing";
}

TEST(PrintableText, EscapesBytesThatAreNoUtf8) {
  for (const std::string bad :
       {"\xFF", "\x80", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\xF8\x88\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(bad)) << printable(bad);
    EXPECT_THAT(printable(bad), HasSubstr("\\x"));
    EXPECT_TRUE(is_utf8(printable(bad)));
  }
  EXPECT_TRUE(is_utf8("\xC3\xA4"));
  EXPECT_TRUE(is_utf8(""));
}

TEST(PrintableText, CutsTheMiddle) {
  const std::string cut = printable(std::string(500, 'a') + std::string(500, 'b'), 100);
  EXPECT_EQ(cut, std::string(50, 'a') + " ... " + std::string(50, 'b'));
  EXPECT_EQ(printable("short", 100), "short");
}

TEST(PrintableText, MessagesNeverHideTheirRemedy) {
  const InputError error("f", std::string("place\0", 6), std::string(1'000'000, 'x') + "\x1b[2J", "do that");
  const std::string message = error.what();
  EXPECT_THAT(message, EndsWith("(remedy: do that)"));
  EXPECT_LT(message.size(), 5000u);
  EXPECT_THAT(message, Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace lmdbench
