// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <micro/benchmark_program.h>
#include <micro/program.h>

#include <cstdlib>

namespace lmdbench::micro {

int run_benchmarks(int argc, char** argv, const std::function<void()>& add) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return static_cast<int>(ExitCode::USAGE);
  return report_errors([&add] {
    add();
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

}  // namespace lmdbench::micro
