// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/fuzz/check_triangle_pair.h"

#include <cstdio>
#include <cstdlib>

/// libFuzzer's entry: lmdbench_triangle_fuzz tests/geometry/fuzz/corpus -max_len=144. Finds go to
/// the corpus, which the test FuzzCorpus replays.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto pair = lmdbench::testing::pair_from_bytes({data, size});
  if (!pair) return 0;
  const std::string broken = lmdbench::testing::broken_promise(*pair);
  if (broken.empty()) return 0;
  std::fputs(broken.c_str(), stderr);
  std::abort();
}
