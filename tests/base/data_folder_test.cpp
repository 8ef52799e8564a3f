// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>

#include <gtest/gtest.h>
#include <support/scratch_directory.h>

namespace lmdbench::testing {
namespace {

TEST(DataFolder, StandsBesideTheFolderOfAnInstalledProgram) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch / "usr/share/lmdbench");
  EXPECT_EQ(data_folder_of(scratch / "usr/bin/lmdbench"), scratch / "usr/share/lmdbench");
}

TEST(DataFolder, StandsBesideTheProgramInABuildTree) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch / "build/release/share/lmdbench");
  EXPECT_EQ(data_folder_of(scratch / "build/release/lmdbench"), scratch / "build/release/share/lmdbench");
}

TEST(DataFolder, IsEmptyWhereThereIsNone) {
  const ScratchDirectory scratch;
  EXPECT_TRUE(data_folder_of(scratch / "bin/lmdbench").empty());
}

TEST(DataFolder, OfThisBuildHoldsTheScriptsOfTheReport) {
  EXPECT_TRUE(std::filesystem::exists(data_folder() / "scripts/report/report.py"));
}

}  // namespace
}  // namespace lmdbench::testing
