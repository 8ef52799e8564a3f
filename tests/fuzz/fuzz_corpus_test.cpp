// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "json_mutation.h"
#include "targets.h"
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <array>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench::testing {
namespace {

struct FuzzTarget {
  std::string_view name;
  std::optional<std::string> (*broken_promise)(std::string_view bytes);
  bool is_json;
};

constexpr std::array<FuzzTarget, 11> TARGETS{{{"off", &broken_off, false},
                                              {"ply", &broken_ply, false},
                                              {"obj", &broken_obj, false},
                                              {"import", &broken_import, false},
                                              {"manifest", &broken_manifest, true},
                                              {"tum", &broken_tum, false},
                                              {"path", &broken_path, true},
                                              {"result", &broken_result, false},
                                              {"experiment", &broken_experiment, true},
                                              {"sweep", &broken_sweep, true},
                                              {"journal", &broken_journal, false}}};

std::vector<std::string> corpus_of(const FuzzTarget& target) {
  std::vector<std::string> contents;
  for (const auto& file :
       files_in(std::filesystem::path(LMDBENCH_SOURCE_DIR "/tests/fuzz/corpus") / target.name))
    contents.push_back(read_text(file));
  return contents;
}

class FuzzCorpus : public ::testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzCorpus, KeepsEveryPromise) {
  const std::vector<std::string> corpus = corpus_of(GetParam());
  ASSERT_GE(corpus.size(), 5U);
  int taken = 0;
  for (std::size_t i = 0; i < corpus.size(); ++i) {
    const std::optional<std::string> broken = GetParam().broken_promise(corpus[i]);
    EXPECT_EQ(broken.value_or(""), "") << GetParam().name << ", file " << i << " by name";
    taken += broken.has_value();
  }
  // Otherwise neither this test nor the fuzzer would get beyond the first check of the reader.
  EXPECT_GT(taken, 0) << GetParam().name;
}

/// A few mutations of every file in every run of tests; the fuzzers do them for hours.
TEST_P(FuzzCorpus, KeepsEveryPromiseForItsMutations) {
  std::mt19937 random(29);
  const int mutations = GetParam().name == "import" || GetParam().name == "result" ? 1 : 8;
  for (const std::string& content : corpus_of(GetParam())) {
    for (int i = 0; i < mutations; ++i) {
      std::string bytes = GetParam().is_json && i % 2 == 0 ? mutated_json(content, random()) : content;
      if (bytes == content && !bytes.empty()) {
        if (i % 3 == 0) bytes.resize(random() % bytes.size());
        for (int k = 0; k < 3 && !bytes.empty(); ++k)
          bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      ASSERT_EQ(GetParam().broken_promise(bytes).value_or(""), "") << GetParam().name << ": " << bytes;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzCorpus, ::testing::ValuesIn(TARGETS),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(MutatedJson, StaysJsonAndChanges) {
  EXPECT_EQ(mutated_json("no JSON", 1), "");
  int changed = 0;
  for (unsigned int seed = 0; seed < 100; ++seed)
    changed += mutated_json(R"({"a":[1,2,{"b":null}]})", seed) != R"({"a":[1,2,{"b":null}]})";
  EXPECT_GT(changed, 70);
}

}  // namespace
}  // namespace lmdbench::testing
