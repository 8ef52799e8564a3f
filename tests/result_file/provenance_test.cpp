// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/result_file/provenance.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result_file/result_reading.h>

#include <ctime>
#include <map>
#include <set>

namespace lmdbench {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using testing::OpenResult;
using testing::ScratchDirectory;

TEST(Provenance, IdentifiesTheRun) {
  const ScratchDirectory directory;
  const std::string experiment = R"({"name": "hard", "cutoff": 0.001})";
  ResultWriter writer(directory / "a.h5");
  write_provenance(writer, {"lmdbench", "run", "hard.json"}, experiment, R"({"probes": []})",
                   {{"path", directory / "path.tum", sha256_of_text("abc"), 3}}, machine_info());
  writer.commit();

  const OpenResult result(directory / "a.h5");
  EXPECT_EQ(result.text_attribute("/", "format"), "lmdbench-result");
  EXPECT_EQ(result.integer_attribute("/", "format_version"), 2);
  EXPECT_THAT(result.text_attribute("/", "creator"), ContainsRegex("^lmdbench [0-9]+\\.[0-9]+\\.[0-9]+$"));
  std::tm created{};
  const std::string text = result.text_attribute("/", "created_utc");
  ASSERT_NE(::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &created), nullptr) << text;
  EXPECT_LE(std::abs(std::difftime(::timegm(&created), std::time(nullptr))), 60.0);

  for (const char* name :
       {"program_version", "git_commit", "git_dirty", "compiler", "compiler_flags", "build_type"}) {
    EXPECT_TRUE(result.has_attribute("/provenance", name)) << name;
  }
  EXPECT_THAT(result.text_attribute("/provenance/libraries", "eigen"),
              ContainsRegex("^3\\.[0-9]+\\.[0-9]+$"));
  EXPECT_THAT(result.text_attribute("/provenance/libraries", "hdf5"), ContainsRegex("^1\\.[0-9]+\\.[0-9]+$"));
  EXPECT_TRUE(result.has_attribute("/provenance/machine", "processor"));
  EXPECT_THAT(result.strings("/provenance/argv"), ElementsAre("lmdbench", "run", "hard.json"));
  EXPECT_THAT(result.strings("/provenance/experiment"), ElementsAre(experiment));
  EXPECT_THAT(result.strings("/provenance/plan"), ElementsAre(R"({"probes": []})"));
  EXPECT_THAT(result.strings("/provenance/inputs/role"), ElementsAre("path"));
  EXPECT_THAT(result.strings("/provenance/inputs/sha256"),  // FIPS 180-2, "abc"
              ElementsAre("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"));
  EXPECT_THAT(result.integers("/provenance/inputs/size"), ElementsAre(3));
}

TEST(MachineInfo, HasEveryFactOnceAndNoneEmpty) {
  std::map<std::string, std::string> facts;
  for (const auto& [name, value] : machine_info()) {
    EXPECT_TRUE(facts.emplace(name, value).second) << name;
    EXPECT_FALSE(value.empty()) << name;
  }
  EXPECT_GE(std::stol(facts.at("logical_processors")), 1);
  EXPECT_GE(std::stol(facts.at("usable_processors")), 1);
  EXPECT_GT(std::stoll(facts.at("memory_bytes")), 0);
  EXPECT_THAT(facts.at("load_average_1_minute"), ContainsRegex("^[0-9]+\\.[0-9]+$"));
  EXPECT_THAT(std::set<std::string>({"on", "off", "unknown"}),
              ::testing::Contains(facts.at("frequency_boost")));
}

}  // namespace
}  // namespace lmdbench
