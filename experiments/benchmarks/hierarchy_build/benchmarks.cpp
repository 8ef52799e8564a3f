// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/lmd/body.h>

#include <benchmarks/benchmark_program.h>
#include <benchmarks/hierarchy_build/benchmarks.h>
#include <support/bodies.h>

#include <iostream>

namespace lmdbench::experiments {
namespace {

constexpr const char* MESHES[] = {"bunny-16k", "bunny-75k", "armadillo", "dragon-871k"};
constexpr std::size_t PROBE_COUNT = 5;

struct Prepared {
  std::shared_ptr<const Body> body;
  std::vector<BuildProbe> probes;
};

void add_build(const BuildImplementation& implementation, const std::string& mesh,
               const std::function<const Prepared&()>& prepared) {
  const auto objection = once([implementation, prepared] {
    const auto build = implementation.make(prepared().body->surface());
    return check_build(implementation, *build, prepared().probes);
  });
  const auto run = [implementation, prepared, objection](benchmark::State& state) {
    if (!accept(state, objection())) return;
    const Surface& surface = prepared().body->surface();
    const auto build = implementation.make(surface);
    for (auto _ : state) {
      build->build();
      state.PauseTiming();
      build->clear();
      state.ResumeTiming();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(surface.mesh.triangles.size()));
  };
  benchmark::RegisterBenchmark(("hierarchy_build/" + implementation.name + "/" + mesh).c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

}  // namespace

void add_build_benchmarks(const std::vector<BuildImplementation>& implementations) {
  const SceneChoice size;
  for (const std::string mesh : MESHES) {
    std::shared_ptr<const Body> body;
    try {
      body = load_body(mesh, benchmark_meshes(), size.diagonal);
    } catch (const InputError& error) {
      std::cerr << "left out: " << error.what() << '\n';
      continue;
    }
    const auto prepared = once([body] {
      return Prepared{body, build_probes(body->surface().mesh, PROBE_COUNT)};
    });
    for (const BuildImplementation& implementation : implementations)
      add_build(implementation, mesh, prepared);
  }
}

}  // namespace lmdbench::experiments
