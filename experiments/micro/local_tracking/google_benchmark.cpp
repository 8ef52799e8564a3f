// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/benchmark_program.h>
#include <micro/frame_benchmarks.h>
#include <micro/local_tracking/implementation.h>

/// The task "local tracking" under Google Benchmark: names are local_tracking/<implementation>/<path>, the
/// counter "per_frame" is the time of one frame.
int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  std::vector<RecordedPath> paths;
  return run_benchmarks(argc, argv, [&paths] {
    paths = contact_paths();
    add_frame_benchmarks("local_tracking", tracking_implementations(), paths);
  });
}
