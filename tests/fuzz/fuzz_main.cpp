// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "json_mutation.h"
#include "targets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

/// libFuzzer's entries of one target, whose check the macro LMDBENCH_FUZZ_CHECK names:
/// lmdbench_off_fuzz CORPUS. With LMDBENCH_FUZZ_JSON half of the mutations keep the text JSON.
/// Finds go to tests/fuzz/corpus; FuzzCorpus replays them. scripts/fuzz.sh runs all targets.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::optional<std::string> broken =
      lmdbench::testing::LMDBENCH_FUZZ_CHECK({reinterpret_cast<const char*>(data), size});
  if (broken.value_or("").empty()) return 0;
  std::fprintf(stderr, "broken promise: %s\n", broken->c_str());
  std::abort();
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  if (LMDBENCH_FUZZ_JSON && seed % 2 == 0) {
    const std::string text =
        lmdbench::testing::mutated_json({reinterpret_cast<const char*>(data), size}, seed);
    if (!text.empty() && text.size() <= most) {
      std::copy(text.begin(), text.end(), reinterpret_cast<char*>(data));
      return text.size();
    }
  }
  return LLVMFuzzerMutate(data, size, most);
}
