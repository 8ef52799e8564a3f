// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>

#include "support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;

TEST(Limits, TheTableIsInTheOrderOfItsEnumAndUsualValuesAreAllowed) {
  std::size_t i = 0;
  for (const LimitInfo& info : limit_table()) {
    EXPECT_EQ(static_cast<std::size_t>(info.limit), i++) << info.name;
    EXPECT_LE(info.usual, info.most) << info.name;
    EXPECT_EQ(limit_of(info.limit), info.usual) << info.name;
    EXPECT_THAT(raise_remedy(info.limit), HasSubstr("--limit " + std::string(info.name) + "=")) << info.name;
  }
}

TEST(Limits, SetsANumberAndRefusesTheRest) {
  set_limit("frames=12");
  EXPECT_EQ(limit_of(Limit::FRAMES), 12);
  set_limit("frames=10000000");
  for (const char* bad : {"frames", "frames=", "frames=0", "frames=-1", "frames=1e6", "frames=10 ",
                          "json-depth=101", "frames=99999999999999999999"})
    EXPECT_THAT(message_of<UsageError>([&] { set_limit(bad); }), HasSubstr("no whole number from 1 to"))
        << bad;
  EXPECT_THAT(message_of<UsageError>([] { set_limit("fames=1"); }), HasSubstr("frames"));
  EXPECT_EQ(limit_of(Limit::FRAMES), 10'000'000);
}

}  // namespace
}  // namespace lmdbench
