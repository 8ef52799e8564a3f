// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/hierarchy_build/benchmarks.h>

/// The task "hierarchy build" under Google Benchmark.
int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  return run_build_benchmarks(argc, argv, build_implementations());
}
