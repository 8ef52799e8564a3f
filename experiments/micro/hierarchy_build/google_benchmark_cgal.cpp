// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/hierarchy_build/benchmarks.h>

/// The task "hierarchy build" for CGAL's tree, whose licence keeps it out of the other program. FCL stands
/// beside it, for a ratio from one process.
int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  return run_build_benchmarks(argc, argv, {fcl_build(), cgal_build()});
}
