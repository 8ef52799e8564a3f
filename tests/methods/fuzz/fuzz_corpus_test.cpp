// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "methods/fuzz/check_lmd_sets.h"
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <random>
#include <vector>

namespace lmdbench::testing {
namespace {

TEST(LmdFuzzCorpus, KeepsEveryPromise) {
  const auto files = files_in(LMDBENCH_SOURCE_DIR "/tests/methods/fuzz/corpus");
  ASSERT_GE(files.size(), 5u);
  for (const auto& path : files) {
    const std::string content = read_text(path);
    const auto fuzz = scene_from_bytes(std::vector<std::uint8_t>(content.begin(), content.end()));
    ASSERT_TRUE(fuzz) << path;
    EXPECT_EQ(broken_promise(*fuzz), "") << path;
  }
}

TEST(LmdFuzzCheck, KeepsEveryPromiseForRandomBytes) {
  std::mt19937_64 random(701);
  int scenes = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::uint8_t> bytes(160);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (const auto fuzz = scene_from_bytes(bytes)) {
      ++scenes;
      ASSERT_EQ(broken_promise(*fuzz), "") << "scene " << i;
    }
  }
  EXPECT_GT(scenes, 2000);
}

TEST(LmdFuzzCheck, NeedsBytesForThePose) {
  EXPECT_FALSE(scene_from_bytes(std::vector<std::uint8_t>(3)));
}

}  // namespace
}  // namespace lmdbench::testing
