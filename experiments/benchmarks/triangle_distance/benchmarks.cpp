// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <benchmarks/tasks.h>
#include <benchmarks/triangle_distance/implementation.h>
#include <triangles/brute_force_distance.h>

#include <cmath>
#include <string>

namespace lmdbench::experiments {
namespace {

constexpr std::size_t PAIR_COUNT = 4096;

/// Relative to the triangles' size, which is about 1.
constexpr double TOLERANCE = 1e-7;

std::string objection(const PairFamily& family, const std::vector<double>& distances) {
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto expected = static_cast<double>(testing::brute_force_distance(family.a[i], family.b[i]));
    if (!(std::abs(distances[i] - expected) <= TOLERANCE))
      return "pair " + std::to_string(i) + " of family " + family.name + ": " + std::to_string(distances[i]) +
             " instead of " + std::to_string(expected);
  }
  return {};
}

void run(benchmark::State& state, const DistanceImplementation& implementation, const PairFamily& family) {
  std::vector<double> distances(family.size());
  implementation.run(family, distances);
  const std::string wrong = objection(family, distances);
  if (!wrong.empty()) {
    state.SkipWithError(wrong.c_str());
    return;
  }
  for (auto _ : state) {
    implementation.run(family, distances);
    benchmark::DoNotOptimize(distances.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(family.size()));
}

}  // namespace

void add_triangle_distances() {
  static const std::vector<PairFamily> families = pair_families(PAIR_COUNT);
  for (const PairFamily& family : families)
    for (const DistanceImplementation& implementation : distance_implementations())
      benchmark::RegisterBenchmark(
          ("triangle_distance/" + implementation.name + "/" + family.name).c_str(),
          [&family, implementation](benchmark::State& state) { run(state, implementation, family); })
          ->Unit(benchmark::kMicrosecond);
}

}  // namespace lmdbench::experiments
