// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/benchmarks.h>

/// The task "global search" under Google Benchmark.
int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  return run_search_benchmarks(argc, argv, search_implementations());
}
