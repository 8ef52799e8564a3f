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

/// What the Google Benchmark programs share.
namespace lmdbench::experiments {

/// One input, many implementations.
struct BenchmarkTask {
  std::string name;           ///< Benchmarks are called <name>/<implementation>/<input>.
  std::function<void()> add;  ///< Registers them.
};

/// The main function of such a program: reads Google Benchmark's flags and the names of tasks, registers the
/// benchmarks of those (all without a name), runs them. Errors are told on standard error.
/// @return exit code (error.h)
int run_benchmarks(int argc, char** argv, const std::vector<BenchmarkTask>& tasks);

/// Folder of built meshes: the variable LMDBENCH_MESHES, "meshes" unless set.
std::filesystem::path benchmark_meshes();

/// A function that calls `make` when it is called first and gives the same answer ever after. Google
/// Benchmark calls a benchmark many times, to find the number of iterations and for every repetition; what is
/// expensive and not timed is made once, and only for the benchmarks that the filter lets through.
template <class Make>
auto once(Make make) {
  return [ make = std::move(make),
           answer = std::make_shared<std::optional<std::invoke_result_t<Make>>>() ]() -> auto& {
    if (!answer->has_value()) answer->emplace(make());
    return **answer;
  };
}

/// Writes the error beside the time, as counters; skips the benchmark with the reason when the implementation
/// breaks its promise.
/// @return whether it may be timed
bool accept(benchmark::State& state, const LmdError& error);

/// The same for a check that either passes or objects.
bool accept(benchmark::State& state, const std::string& objection);

}  // namespace lmdbench::experiments
