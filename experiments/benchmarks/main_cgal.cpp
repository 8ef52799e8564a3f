// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/benchmark_program.h>
#include <benchmarks/global_search/benchmarks.h>
#include <benchmarks/hierarchy_build/benchmarks.h>

/// lmdbench-benchmark-cgal [TASK...]: the tasks of CGAL's tree, which its licence keeps out of the
/// other program. FCL runs beside it, for a ratio from one process.
int main(int argc, char** argv) {
  using namespace lmdbench::experiments;
  return run_benchmarks(argc, argv,
                        {{"global_search",
                          [] {
                            add_search_benchmarks({fcl_cold_search(), cgal_vertex_search()});
                          }},
                         {"hierarchy_build", [] {
                            add_build_benchmarks({fcl_build(), cgal_build()});
                          }}});
}
