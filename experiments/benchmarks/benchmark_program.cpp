// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <benchmarks/benchmark_program.h>
#include <fmt/format.h>
#include <support/program.h>

#include <algorithm>
#include <cstdlib>

namespace lmdbench::experiments {

namespace {

std::vector<BenchmarkTask> chosen_tasks(const std::vector<BenchmarkTask>& tasks,
                                        const std::vector<std::string>& names) {
  if (names.empty()) return tasks;
  std::vector<BenchmarkTask> chosen;
  std::vector<std::string> known;
  for (const BenchmarkTask& task : tasks) known.push_back(task.name);
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      throw UsageError("", name, "is neither a task nor a flag of Google Benchmark",
                       fmt::format("name tasks of {}; --help lists the flags", fmt::join(known, ", ")));
    chosen.push_back(tasks[static_cast<std::size_t>(found - known.begin())]);
  }
  return chosen;
}

}  // namespace

int run_benchmarks(int argc, char** argv, const std::vector<BenchmarkTask>& tasks) {
  benchmark::Initialize(&argc, argv);
  const std::vector<std::string> names(argv + 1, argv + argc);
  return report_errors([&] {
    for (const BenchmarkTask& task : chosen_tasks(tasks, names)) task.add();
    benchmark::RunSpecifiedBenchmarks();
    return static_cast<int>(ExitCode::DONE);
  });
}

std::filesystem::path benchmark_meshes() {
  const char* meshes = std::getenv("LMDBENCH_MESHES");
  return meshes == nullptr ? SceneChoice().meshes : meshes;
}

bool accept(benchmark::State& state, const std::string& objection) {
  if (!objection.empty()) state.SkipWithError(objection.c_str());
  return objection.empty();
}

bool accept(benchmark::State& state, const LmdError& error) {
  if (!accept(state, error.objection)) return false;
  if (error.same.true_lmds > 0) {
    state.counters["recall"] = error.same.recall();
    state.counters["precision"] = error.same.precision();
    state.counters["recall_adjacent"] = error.neighbours.recall();
    state.counters["precision_adjacent"] = error.neighbours.precision();
  }
  state.counters["worst_minimum_error"] = error.worst_minimum_error;
  return true;
}

}  // namespace lmdbench::experiments
