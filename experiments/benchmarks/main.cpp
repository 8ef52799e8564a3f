// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/benchmark_program.h>
#include <benchmarks/frame_benchmarks.h>
#include <benchmarks/global_search/benchmarks.h>
#include <benchmarks/hierarchy_build/benchmarks.h>
#include <benchmarks/local_tracking/implementation.h>
#include <benchmarks/tasks.h>
#include <benchmarks/whole_frame/implementation.h>

/// lmdbench-benchmark [TASK...] [--benchmark_filter=...]: all or the named tasks, Google Benchmark.
int main(int argc, char** argv) {
  using namespace lmdbench::experiments;
  return run_benchmarks(
      argc, argv,
      {{"triangle_distance", add_triangle_distances},
       {"node_test", add_node_tests},
       {"global_search", [] { add_search_benchmarks(search_implementations()); }},
       {"local_tracking",
        [] { add_frame_benchmarks("local_tracking", tracking_implementations(), contact_paths()); }},
       {"whole_frame", [] { add_frame_benchmarks("whole_frame", frame_implementations(), contact_paths()); }},
       {"hierarchy_build", [] { add_build_benchmarks(build_implementations()); }}});
}
