// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/fuzz/check_triangle_pair.h"
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace lmdbench::testing {
namespace {

TEST(FuzzCorpus, KeepsEveryPromise) {
  const auto files = files_in(LMDBENCH_SOURCE_DIR "/tests/geometry/fuzz/corpus");
  ASSERT_GE(files.size(), 5U);
  for (const auto& path : files) {
    const std::string content = read_text(path);
    const std::vector<std::uint8_t> bytes(content.begin(), content.end());
    const auto pair = pair_from_bytes(bytes);
    ASSERT_TRUE(pair) << path;
    EXPECT_EQ(broken_promise(*pair), "") << path;
    EXPECT_EQ(bytes_from_pair(*pair), bytes) << path;
  }
}

TEST(FuzzCheck, KeepsEveryPromiseForRandomBits) {
  // Any 18 doubles: denormals, infinities, not-a-numbers, and neighbours of numbers already drawn.
  Random random(501);
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 18> numbers;
    for (double& number : numbers) {
      const int kind = random_index(random, 8);
      number = kind == 0   ? std::bit_cast<double>(random())
               : kind == 1 ? std::numeric_limits<double>::denorm_min() * random_index(random, 9)
               : kind == 2 ? 0.0
               : kind < 5  ? numbers[0] * uniform_coordinate(random)
                           : static_cast<double>(random_index(random, 5) - 2);
      if (random_index(random, 50) == 0) number = std::nextafter(number, 0.0);
      if (&number == numbers.data() && kind >= 3) number = log_uniform(random, 1e-300, 1e300);
    }
    std::vector<std::uint8_t> bytes(sizeof numbers);
    std::memcpy(bytes.data(), numbers.data(), sizeof numbers);
    ASSERT_EQ(broken_promise(*pair_from_bytes(bytes)), "") << "pair " << i;
  }
}

TEST(FuzzCheck, NeedsAllBytes) {
  EXPECT_FALSE(pair_from_bytes(std::vector<std::uint8_t>(143)));
}

}  // namespace
}  // namespace lmdbench::testing
