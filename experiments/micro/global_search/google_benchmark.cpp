// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <micro/bodies.h>
#include <micro/global_search/check.h>
#include <micro/poses.h>

#include <cstdlib>
#include <exception>
#include <iostream>

/// The task "global search" under Google Benchmark: names are global_search/<implementation>/<cutoff>. Each
/// implementation is checked against ground truth first and skipped with the reason when it breaks its
/// promise. The folder of meshes comes from the variable LMDBENCH_MESHES ("meshes" unless set).
namespace lmdbench::micro {
namespace {

constexpr std::size_t POSE_COUNT = 40;
constexpr std::uint64_t SEED = 1;

struct Setting {
  std::string cutoff_name;
  Scene scene;
  std::vector<Pose> poses;
  Truth truth;
};

void run(benchmark::State& state, const SearchImplementation& implementation, const Setting& setting) {
  const std::unique_ptr<GlobalSearch> search = implementation.make(setting.scene);
  const SearchError error =
      check_search(implementation, *search, setting.scene, setting.poses, setting.truth);
  if (!error.objection.empty()) {
    state.SkipWithError(error.objection.c_str());
    return;
  }
  std::size_t pose = 0;
  for (auto _ : state) {
    search->run(setting.poses[pose]);
    pose = (pose + 1) % setting.poses.size();
  }
  if (error.feature_pairs.truths > 0) {
    state.counters["recall"] = error.feature_pairs.recall();
    state.counters["precision"] = error.feature_pairs.precision();
  }
  state.counters["worst_minimum_error"] = error.worst_minimum_error;
}

std::vector<Setting> make_settings() {
  SceneChoice choice;
  if (const char* meshes = std::getenv("LMDBENCH_MESHES")) choice.meshes = meshes;
  Scene scene = load_scene(choice);
  const std::vector<Pose> poses =
      grazing_poses(*scene.moving, *scene.fixed.at(0), choice.gap * choice.diagonal, POSE_COUNT, SEED);
  std::vector<Setting> settings;
  for (const auto& [name, cutoff] :
       {std::pair("0.5%", 0.005), std::pair("2%", 0.02), std::pair("5%", 0.05)}) {
    scene.cutoff = cutoff * choice.diagonal;
    settings.push_back({name, scene, poses, exhaustive_truth(scene, poses)});
  }
  return settings;
}

}  // namespace
}  // namespace lmdbench::micro

int main(int argc, char** argv) {
  using namespace lmdbench::micro;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const std::vector<Setting> settings = make_settings();
    for (const SearchImplementation& implementation : search_implementations())
      for (const Setting& setting : settings)
        benchmark::RegisterBenchmark(
            ("global_search/" + implementation.name + "/" + setting.cutoff_name).c_str(),
            [&setting, implementation](benchmark::State& state) { run(state, implementation, setting); })
            ->Unit(benchmark::kMillisecond);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
