// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/benchmark_program.h>
#include <benchmarks/global_search/benchmarks.h>
#include <support/setting.h>

namespace lmdbench::experiments {
namespace {

constexpr std::size_t POSE_COUNT = 40;

struct CheckedSearch {
  std::unique_ptr<GlobalSearch> search;
  LmdError error;
};

void add_search(const SearchImplementation& implementation, const Setting& setting) {
  const auto checked = once([&setting, implementation] {
    CheckedSearch made{implementation.make(setting.scene), {}};
    made.error = check_search(implementation, *made.search, setting.scene, setting.poses, setting.truth);
    return made;
  });
  const auto run = [&setting, checked](benchmark::State& state) {
    if (!accept(state, checked().error)) return;
    GlobalSearch& search = *checked().search;
    std::size_t pose = 0;
    for (auto _ : state) {
      search.run(setting.poses[pose]);
      pose = (pose + 1) % setting.poses.size();
    }
  };
  benchmark::RegisterBenchmark(("global_search/" + implementation.name + "/" + setting.name).c_str(), run)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void add_search_benchmarks(const std::vector<SearchImplementation>& implementations) {
  SceneChoice choice;
  choice.meshes = benchmark_meshes();
  static const std::vector<Setting> settings = grazing_settings(choice, {0.005, 0.02, 0.05}, POSE_COUNT);
  for (const SearchImplementation& implementation : implementations)
    for (const Setting& setting : settings) add_search(implementation, setting);
}

}  // namespace lmdbench::experiments
