// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/registry.h>

#include <study/worlds/cost.h>
#include <study/worlds/heap.h>
#include <study/worlds/scenes.h>
#include <support/random.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

namespace lmdbench::worlds {
namespace {

/// A world of one size along the path.
struct Walker {
  Scene scene;
  std::unique_ptr<Method> method;
  CostRow row;
  std::vector<double> seconds;
  std::vector<bool> same;
  LmdSet lmds;
};

}  // namespace

std::uint64_t counted(const Method& method, const WorkCounters& counters, const std::string& name) {
  for (const CounterDescription& counter : method.description().counters)
    if (counter.name == name) return counters.values[counter.index];
  return 0;
}

const char* to_string(Frames frames) {
  return frames == Frames::COHERENT       ? "along the path"
         : frames == Frames::FROM_SCRATCH ? "from scratch"
                                          : "teleport";
}

std::vector<CostRow> measure_frames(const std::shared_ptr<const Body>& moving,
                                    const std::shared_ptr<const Body>& mesh, double cutoff,
                                    const std::vector<Pose>& poses, Frames frames, const CostChoice& choice) {
  std::vector<Walker> walkers;
  for (const std::size_t count : choice.counts) {
    Walker walker{{moving, crowd(mesh, count, choice.spacing, choice.seed), cutoff}, nullptr, {}, {}, {}, {}};
    walker.method =
        make_method("certified", walker.scene, {{"frame_coherence", frames != Frames::FROM_SCRATCH}});
    walker.row.instances = count;
    walker.row.frames = poses.size();
    walker.seconds.assign(poses.size(), std::numeric_limits<double>::infinity());
    walker.same.assign(poses.size(), true);
    walkers.push_back(std::move(walker));
  }
  // The instance, of a million, that is in contact in each frame, and the path's frame used there.
  experiments::Random random(choice.seed + 1);
  std::vector<std::size_t> which(poses.size()), contact(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    which[i] = random.index(1000000);
    contact[i] = frames == Frames::TELEPORT ? random.index(poses.size()) : i;
  }
  for (std::size_t pass = 0; pass <= choice.passes; ++pass)  // the first is not recorded
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t k = 0; k < walkers.size(); ++k) {
        Walker& walker = walkers[(k + pass + i) % walkers.size()];
        Pose pose = poses[contact[i]];
        if (frames == Frames::TELEPORT)
          pose = walker.scene.fixed[which[i] % walker.scene.fixed.size()].X_WF * pose;
        WorkCounters counters;
        const auto begin = std::chrono::steady_clock::now();
        walker.method->search(pose, walker.lmds, counters);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (pass == 0) continue;
        walker.seconds[i] = std::min(walker.seconds[i], seconds);
        const std::uint64_t touched = counted(*walker.method, counters, "pairs_touched");
        walker.row.queries += static_cast<double>(counted(*walker.method, counters, "broad_phase_queries"));
        walker.row.touched += static_cast<double>(touched);
        walker.row.searched += static_cast<double>(counted(*walker.method, counters, "pairs_searched"));
        walker.row.node_pairs += static_cast<double>(counted(*walker.method, counters, "node_pairs"));
        walker.row.idle_frames += touched == 0 && pass == 1 ? 1 : 0;
      }
      for (Walker& walker : walkers)
        if (walker.lmds.size() != walkers.front().lmds.size()) walker.same[i] = false;
    }
  std::vector<CostRow> rows;
  for (Walker& walker : walkers) {
    CostRow row = walker.row;
    const double all = static_cast<double>(choice.passes * poses.size());
    for (double* sum : {&row.queries, &row.touched, &row.searched, &row.node_pairs}) *sum /= all;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool everywhere =
          std::all_of(walkers.begin(), walkers.end(), [i](const Walker& other) { return other.same[i]; });
      if (!walker.same[i]) ++row.other_sets;
      if (everywhere) row.seconds.push_back(walker.seconds[i]);
    }
    if (row.seconds.empty())
      throw std::runtime_error("no frame has the same set in all worlds: take a larger spacing");
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<PreparationRow> measure_preparation(const std::shared_ptr<const Body>& moving,
                                                const std::shared_ptr<const Body>& mesh, double cutoff,
                                                const CostChoice& choice) {
  const auto wall = [] { return std::chrono::steady_clock::now(); };
  std::vector<PreparationRow> rows;
  for (const std::size_t count : choice.counts) {
    PreparationRow row;
    row.instances = count;
    row.seconds = std::numeric_limits<double>::infinity();
    // A first method prepares all that belongs to the meshes.
    make_method("certified", {moving, crowd(mesh, 2, choice.spacing, choice.seed), cutoff});
    const std::vector<FixedBody> places = crowd(mesh, count, choice.spacing, choice.seed);
    for (int k = 0; k < 3; ++k) {
      const double before = heap_in_use();
      const auto begin = wall();
      const Scene scene{moving, places, cutoff};
      const auto method = make_method("certified", scene);
      row.seconds = std::min(row.seconds, std::chrono::duration<double>(wall() - begin).count());
      row.bytes = heap_in_use() - before;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lmdbench::worlds
