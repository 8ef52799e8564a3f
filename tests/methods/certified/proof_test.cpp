// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

/// PROOF.md and the code name each other's lemmas.
namespace lmdbench {
namespace {

std::filesystem::path source_folder() {
  return std::filesystem::path(LMDBENCH_SOURCE_DIR) / "src" / "lmdbench";
}

/// Numbers of the lemmas in the order of their headings.
std::vector<int> lemmas_of_the_proof() {
  const std::string proof = testing::read_text(source_folder() / "methods" / "certified" / "PROOF.md");
  static const std::regex heading(R"(\*\*Lemma (\d+),)");
  std::vector<int> lemmas;
  for (std::sregex_iterator found(proof.begin(), proof.end(), heading), end; found != end; ++found)
    lemmas.push_back(std::stoi((*found)[1]));
  return lemmas;
}

/// Numbers in the code: "PROOF.md, lemma 3", "PROOF.md, lemmas 13 and 15", "..., lemmas 4 to 6".
std::set<int> lemmas_of_the_code() {
  static const std::regex mention(R"(PROOF\.md,\s+(?:///?\s*)?lemmas?((?:\s|,|and|to|\d|///)+))"),
      numbers(R"((\d+)(?: to (\d+))?)");
  std::set<int> named;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder())) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    const std::string code = testing::read_text(entry.path());
    for (std::sregex_iterator found(code.begin(), code.end(), mention), end; found != end; ++found) {
      const std::string list = (*found)[1];
      for (std::sregex_iterator one(list.begin(), list.end(), numbers); one != end; ++one)
        for (int i = std::stoi((*one)[1]); i <= std::stoi((*one)[(*one)[2].matched ? 2 : 1]); ++i)
          named.insert(i);
    }
  }
  return named;
}

TEST(Proof, LemmasAreNumberedInOrderAndEachIsNamedInTheCode) {
  const std::vector<int> lemmas = lemmas_of_the_proof();
  ASSERT_GE(lemmas.size(), 10u);
  for (std::size_t i = 0; i < lemmas.size(); ++i) EXPECT_EQ(lemmas[i], static_cast<int>(i) + 1);
  EXPECT_EQ(lemmas_of_the_code(), std::set<int>(lemmas.begin(), lemmas.end()));
}

}  // namespace
}  // namespace lmdbench
