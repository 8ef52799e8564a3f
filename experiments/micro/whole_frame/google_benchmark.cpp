// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/benchmark_program.h>
#include <micro/frame_benchmarks.h>
#include <micro/whole_frame/implementation.h>

/// The task "whole frame" under Google Benchmark: names are whole_frame/<implementation>/<path>, the counter
/// "per_frame" is the time of one frame, global searches included.
int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  std::vector<RecordedPath> paths;
  return run_benchmarks(argc, argv, [&paths] {
    paths = contact_paths();
    add_frame_benchmarks("whole_frame", frame_implementations(), paths);
  });
}
