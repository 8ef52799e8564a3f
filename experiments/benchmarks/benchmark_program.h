// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>
#include <support/lmd_error.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Shared by the Google Benchmark programs.
namespace lmdbench::experiments {

/// One input and many implementations.
struct BenchmarkTask {
  std::string name;           ///< Benchmarks are named <name>/<implementation>/<input>.
  std::function<void()> add;  ///< Registers them.
};

/// The main function of these programs: reads Google Benchmark's flags and task names, registers
/// the benchmarks of these tasks (none: of all), runs them. Errors go to standard error.
/// @return exit code (error.h)
int run_benchmarks(int argc, char** argv, const std::vector<BenchmarkTask>& tasks);

/// Folder of built meshes: the variable LMDBENCH_MESHES, or "meshes".
std::filesystem::path benchmark_meshes();

/// A function that calls `make` once, at its first call, and returns that result ever after. Google
/// Benchmark calls a benchmark often, for the number of iterations and repetitions; costly untimed
/// work is done once, and only for benchmarks that pass the filter.
template <class Make>
auto once(Make make) {
  return [ make = std::move(make),
           answer = std::make_shared<std::optional<std::invoke_result_t<Make>>>() ]() -> auto& {
    if (!answer->has_value()) answer->emplace(make());
    return **answer;
  };
}

/// Writes the error beside the time, as counters; skips the benchmark with the reason when the
/// implementation breaks its promise.
/// @return whether it may be timed
bool accept(benchmark::State& state, const LmdError& error);

/// The same for a check; empty when it passes.
bool accept(benchmark::State& state, const std::string& objection);

}  // namespace lmdbench::experiments
