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

TEST(Journal, WhatCannotBeReadIsNotTakenForItsEnd) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "a.jsonl");  // opens, and every read fails
  EXPECT_THROW(Journal{scratch / "a.jsonl"}, EnvironmentError);
}

TEST(Journal, KnowsWhichFileAnEntryIsFrom) {
  const ScratchDirectory scratch;
  Journal(scratch / "b.jsonl").append(entry("y", 0, 2));
  Journal journal(scratch / "a.jsonl");
  journal.append(entry("x", 0, 1));
  journal.read_also(scratch / "b.jsonl");
  EXPECT_EQ(journal.file_of("x", 0), scratch / "a.jsonl");
  EXPECT_EQ(journal.file_of("y", 0), scratch / "b.jsonl");
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

TEST(Journal, TakesWhatAnotherOneHoldsAndWritesOnlyItsOwn) {
  const ScratchDirectory scratch;
  {
    Journal other(scratch / "other.jsonl");
    other.begin("x", 0, {{"node", "a"}});
    other.append(entry("x", 0, 1));
    other.append(entry("y", 0, 2));
  }
  const std::uintmax_t size = std::filesystem::file_size(scratch / "other.jsonl");
  Journal journal(scratch / "own.jsonl");
  journal.begin("x", 0, {{"node", "b"}});
  journal.append(entry("x", 0, 3));
  journal.read_also(scratch / "other.jsonl");
  EXPECT_EQ(journal.find("x", 0)->at("value"), 3) << "what was read first stands";
  EXPECT_EQ(journal.find("y", 0)->at("value"), 2);
  ASSERT_EQ(journal.begun("x", 0).size(), 2u) << "but it was begun twice";
  EXPECT_EQ(journal.begun("x", 0)[1]["node"], "a");
  EXPECT_TRUE(journal.begun("x", 1).empty());
  journal.append(entry("z", 0, 4));
  EXPECT_EQ(std::filesystem::file_size(scratch / "other.jsonl"), size);
  EXPECT_EQ(Journal(scratch / "own.jsonl").find("y", 0), nullptr);

  scratch.write("foreign.jsonl", "notes\n{\"key\":\"f\",\"repetition\":0}\n");
  journal.read_also(scratch / "foreign.jsonl");
  EXPECT_EQ(journal.find("f", 0), nullptr) << "no journal of ours";
}

TEST(Journal, ReadingChangesNoFile) {
  const ScratchDirectory scratch;
  { Journal(scratch / "a.jsonl").append(entry("x", 0, 1)); }
  std::ofstream(scratch / "a.jsonl", std::ios::app) << R"({"key":"y","repet)";  // another writer
  const std::uintmax_t size = std::filesystem::file_size(scratch / "a.jsonl");
  EXPECT_EQ(Journal(scratch / "a.jsonl").find("y", 0), nullptr);
  EXPECT_EQ(std::filesystem::file_size(scratch / "a.jsonl"), size);
}

TEST(Journal, AFailureIsNoEntryAndGoesWhenAnotherTrySucceeds) {
  const ScratchDirectory scratch;
  Journal journal(scratch / "a.jsonl");
  journal.fail("x", "no such mesh");
  EXPECT_EQ(journal.find("x", 0), nullptr);
  ASSERT_NE(Journal(scratch / "a.jsonl").failure("x"), nullptr);
  EXPECT_EQ(*Journal(scratch / "a.jsonl").failure("x"), "no such mesh");
  journal.append(entry("x", 0, 1));
  EXPECT_EQ(journal.failure("x"), nullptr);
  EXPECT_EQ(Journal(scratch / "a.jsonl").failure("x"), nullptr);
}

TEST(Journal, KeepsNamesThatAreNoText) {
  const ScratchDirectory scratch;
  Journal journal(scratch / "a.jsonl");
  journal.begin("x", 0, {{"command", "\xff\xfe"}});
  EXPECT_EQ(Journal(scratch / "a.jsonl").begun("x", 0).size(), 1u);
}

}  // namespace
}  // namespace lmdbench
