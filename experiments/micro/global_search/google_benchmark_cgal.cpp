// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/benchmarks.h>

/// The task "global search" for CGAL's tree, whose licence keeps it out of the other program. FCL stands
/// beside it, for a ratio from one process.
int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  return run_search_benchmarks(argc, argv, {fcl_cold_search(), cgal_vertex_search()});
}
