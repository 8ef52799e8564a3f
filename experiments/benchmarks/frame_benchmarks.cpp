// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/benchmark_program.h>
#include <benchmarks/frame_benchmarks.h>

namespace lmdbench::experiments {
namespace {

/// Here both paths slide and turn and are nearly always in contact.
constexpr std::size_t FIRST_FRAME = 1000;
constexpr std::size_t FRAME_COUNT = 1500;
/// No divisor of the frames between two searches, so that sets of every age are checked.
constexpr std::size_t CHECK_STRIDE = 47;

struct CheckedLoop {
  std::unique_ptr<FrameLoop> loop;
  LmdError error;
};

void add_loop(const std::string& task, const FrameImplementation& implementation, const RecordedPath& path) {
  const auto checked = once([&path, implementation] {
    CheckedLoop made{implementation.make(path), {}};
    made.error = check_frames(implementation, *made.loop, path);
    return made;
  });
  const auto run = [checked, frames = frames_of(implementation, path)](benchmark::State& state) {
    if (!accept(state, checked().error)) return;
    FrameLoop& loop = *checked().loop;
    for (auto _ : state)
      for (const std::size_t frame : frames) loop.step(frame);
    state.counters["per_frame"] =
        benchmark::Counter(static_cast<double>(frames.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  };
  benchmark::RegisterBenchmark((task + "/" + implementation.name + "/" + path.name).c_str(), run)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

const std::vector<RecordedPath>& contact_paths() {
  static const std::vector<RecordedPath> paths = [] {
    std::vector<RecordedPath> loaded;
    for (const char* experiment : {"experiments/bunny-hard.json", "experiments/bunny-soft.json"})
      loaded.push_back(load_path({experiment, benchmark_meshes(), FIRST_FRAME, FRAME_COUNT, CHECK_STRIDE}));
    return loaded;
  }();
  return paths;
}

void add_frame_benchmarks(const std::string& task, const std::vector<FrameImplementation>& implementations,
                          const std::vector<RecordedPath>& paths) {
  for (const RecordedPath& path : paths)
    for (const FrameImplementation& implementation : implementations) add_loop(task, implementation, path);
}

}  // namespace lmdbench::experiments
