// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "methods/fuzz/check_lmd_sets.h"

#include <cstdio>
#include <cstdlib>

/// libFuzzer's entry: lmdbench_lmd_fuzz tests/methods/fuzz/corpus. Finds go to the corpus, which
/// the test LmdFuzzCorpus replays.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto fuzz = lmdbench::testing::scene_from_bytes({data, size});
  if (!fuzz) return 0;
  const std::string broken = lmdbench::testing::broken_promise(*fuzz);
  if (broken.empty()) return 0;
  std::fputs(broken.c_str(), stderr);
  std::abort();
}
