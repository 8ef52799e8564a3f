// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace lmdbench {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

TEST(BuildInfo, SaysWhatWasBuilt) {
  const BuildInfo& info = build_info();
  EXPECT_THAT(info.git_commit, ContainsRegex("^([0-9a-f]{40}|unknown)$"));
  EXPECT_THAT(std::set<std::string>({"yes", "no", "unknown"}), ::testing::Contains(info.git_dirty));
  EXPECT_EQ(info.git_commit == "unknown", info.git_dirty == "unknown");
  EXPECT_THAT(info.compiler, ContainsRegex("^[A-Za-z]+ [0-9]+"));
  EXPECT_THAT(info.compiler_flags, HasSubstr("-ffp-contract=off"));
  EXPECT_THAT(info.compiler_flags, HasSubstr("-DEIGEN_MAX_ALIGN_BYTES=16"));
  for (const auto& [name, version] : info.libraries) EXPECT_FALSE(version.empty()) << name;
}

TEST(BuildInfo, VersionTextNamesCommitCompilerAndLibraries) {
  const std::string text = version_text();
  EXPECT_EQ(text.rfind("lmdbench " + build_info().version, 0), 0u);
  EXPECT_THAT(text, HasSubstr(build_info().git_commit));
  EXPECT_THAT(text, HasSubstr(build_info().compiler));
  EXPECT_THAT(text, HasSubstr("eigen 3."));
}

}  // namespace
}  // namespace lmdbench
