// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/benchmark_program.h>
#include <benchmarks/node_test/implementation.h>
#include <benchmarks/tasks.h>

namespace lmdbench::experiments {
namespace {

constexpr std::size_t POSE_COUNT = 10;

struct CheckedNodeTest {
  std::unique_ptr<NodeTest> test;
  std::string objection;
};

void add_node_test(const NodeTestImplementation& implementation, const Setting& setting) {
  const auto checked = once([&setting, implementation] {
    CheckedNodeTest made{implementation.make(setting), {}};
    made.objection = made.test->objection();
    return made;
  });
  const auto run = [&setting, checked](benchmark::State& state) {
    if (!accept(state, checked().objection)) return;
    NodeTest& test = *checked().test;
    for (auto _ : state) {
      test.run();
      benchmark::ClobberMemory();
    }
    const auto pairs = static_cast<double>(test.pair_count());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(test.pair_count()));
    state.counters["per_pair"] = benchmark::Counter(
        pairs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["pairs_a_query"] = pairs / static_cast<double>(setting.poses.size());
    state.counters["survivors"] = static_cast<double>(test.survivor_count()) / pairs;
  };
  benchmark::RegisterBenchmark(("node_test/" + implementation.name + "/" + setting.name).c_str(), run)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace

void add_node_tests() {
  SceneChoice choice;
  choice.meshes = benchmark_meshes();
  static const std::vector<Setting> settings = grazing_settings(choice, {0.005, 0.05}, POSE_COUNT);
  for (const NodeTestImplementation& implementation : node_test_implementations())
    for (const Setting& setting : settings) add_node_test(implementation, setting);
}

}  // namespace lmdbench::experiments
