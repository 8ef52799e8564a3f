// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/benchmark_program.h>
#include <benchmarks/tasks.h>

/// lmdbench-benchmark [TASK...] [--benchmark_filter=...]: all or the named tasks, Google Benchmark.
int main(int argc, char** argv) {
  using namespace lmdbench::experiments;
  return run_benchmarks(argc, argv,
                        {{"triangle_distance", add_triangle_distances},
                         {"node_test", add_node_tests},
                         {"global_search", add_global_searches},
                         {"local_tracking", add_local_trackings},
                         {"whole_frame", add_whole_frames},
                         {"hierarchy_build", add_hierarchy_builds}});
}
