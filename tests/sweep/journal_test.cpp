// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/sweep/journal.h>

#include <gtest/gtest.h>
#include <support/scratch_directory.h>

#include <filesystem>
#include <fstream>

namespace lmdbench {
namespace {

using Json = nlohmann::json;
using testing::ScratchDirectory;

Json entry(const std::string& key, int repetition, int value) {
  return {{"key", key}, {"repetition", repetition}, {"value", value}};
}

TEST(Journal, KnowsAgainWhatItWasTold) {
  const ScratchDirectory scratch;
  Journal journal(scratch / "a.jsonl");
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.jsonl")) << "nothing is done yet";
  journal.append(entry("x", 0, 1));
  journal.append(entry("x", 1, 2));
  EXPECT_EQ(journal.find("x", 1)->at("value"), 2);
  EXPECT_TRUE(is_own_journal(scratch / "a.jsonl"));

  const Journal again(scratch / "a.jsonl");
  ASSERT_NE(again.find("x", 0), nullptr);
  EXPECT_EQ(again.find("x", 0)->at("value"), 1);
  EXPECT_EQ(again.find("x", 1)->at("value"), 2);
  EXPECT_EQ(again.find("x", 2), nullptr);
  EXPECT_EQ(again.find("y", 0), nullptr);
}

TEST(Journal, DropsALineThatWasCutShortAndWritesBehindWhatIsWhole) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch / "a.jsonl";
  {
    Journal journal(file);
    journal.append(entry("x", 0, 1));
    journal.append(entry("x", 1, 2));
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 5);
  {
    Journal journal(file);
    EXPECT_NE(journal.find("x", 0), nullptr);
    EXPECT_EQ(journal.find("x", 1), nullptr);
    journal.append(entry("x", 1, 3));
  }
  const Journal again(file);
  ASSERT_NE(again.find("x", 1), nullptr);
  EXPECT_EQ(again.find("x", 1)->at("value"), 3);
}

TEST(Journal, IsNotTheFileOfSomebodyElse) {
  const ScratchDirectory scratch;
  EXPECT_FALSE(is_own_journal(scratch.write("notes.jsonl", "{\"format\":\"other\"}\n")));
}

TEST(Journal, SaysThatItCannotBeWritten) {
  const ScratchDirectory scratch;
  Journal journal(scratch / "missing" / "a.jsonl");
  EXPECT_THROW(journal.append(entry("x", 0, 1)), EnvironmentError);
}

}  // namespace
}  // namespace lmdbench
