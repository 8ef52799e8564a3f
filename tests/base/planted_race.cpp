// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/parallel.h>

#include <chrono>
#include <cstdio>
#include <thread>

/// A planted race in a loop of base/parallel.h: every thread adds to the same number. The thread
/// sanitizer must report it and end the program with its exit code. A build in which the program
/// passes proves nothing about races (tests/base/CMakeLists.txt).
int main() {
  long sum = 0;
  lmdbench::parallel_for(64, [&](std::size_t i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    sum += static_cast<long>(i);
  });
  std::printf("%ld\n", sum);
  return 0;
}
