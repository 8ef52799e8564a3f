// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/methods/registry.h>

#include <study/continuous_force/measures.h>
#include <support/random.h>
#include <support/timing.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench::continuous_force {

LoopRow measure_loops(const PathScene& scene, std::size_t loops, std::size_t steps, std::uint64_t seed,
                      std::optional<LayeredChoice> layered) {
  LoopRow row{scene.name, 0, steps, zeros(layered.has_value()), zeros(layered.has_value())};
  Renderer renderer(scene.scene, scene.profile, layered);
  experiments::Random random(seed);
  const double radius = scene.profile.cutoff;
  while (row.loops < loops) {
    const Pose& centre = scene.poses[random.index(scene.poses.size())];
    const Vec3 first = random.direction();
    const Vec3 second = first.cross(random.direction()).normalized();
    std::array<double, LAWS> work{};
    bool touches = false, pushes = false;
    Vec3 last = centre.translation + radius * first;
    for (std::size_t k = 0; k < steps && !touches; ++k) {
      const auto at = [&](double turns) {
        const double angle = 2.0 * std::numbers::pi * turns;
        return Vec3(centre.translation + radius * (std::cos(angle) * first + std::sin(angle) * second));
      };
      const double share = 1.0 / static_cast<double>(steps);
      const Vec3 next = at(static_cast<double>(k + 1) * share);
      const Rendered here = renderer.at({at((static_cast<double>(k) + 0.5) * share), centre.rotation});
      touches = std::ranges::any_of(here.critical, [](const CriticalPair& c) { return c.pair.intersecting; });
      pushes = pushes || here.merges > 0;
      for (std::size_t law = 0; law < LAWS; ++law) work[law] += here.force[law].dot(next - last);
      last = next;
    }
    // Only loops without intersections count, and only if minima merge along them.
    if (touches || !pushes) continue;
    ++row.loops;
    for (std::size_t law = 0; law < LAWS; ++law) {
      const double share = std::abs(work[law]) / radius;
      row.largest[law] = std::max(row.largest[law], share);
      row.mean[law] += share / static_cast<double>(loops);
    }
  }
  return row;
}

std::vector<CostRow> measure_cost(const PathScene& scene, std::size_t poses, std::size_t repetitions) {
  std::vector<CostRow> rows;
  for (const bool coherent : {false, true}) {
    const nlohmann::json options{{"frame_coherence", coherent}};
    const auto plain = make_method("certified", scene.scene, options),
               critical = make_method("certified", scene.scene, options),
               merging = make_method("certified", scene.scene, options);
    MergeFinder merges(scene.scene);
    std::vector<Merge> found;
    LmdSet lmds;
    CriticalSet set;
    WorkCounters ignored;
    // Coherent: consecutive frames. From scratch: spread over the path.
    const std::size_t count = std::min(poses, scene.poses.size());
    const std::size_t stride = coherent ? 1 : scene.poses.size() / count;
    const std::size_t first = coherent ? (scene.poses.size() - count) / 2 : 0;
    const auto pose = [&](std::size_t i) -> const Pose& { return scene.poses[first + i * stride]; };
    const auto law = [&](std::size_t which) {
      aggregations()[which].combine({set, found}, scene.profile, Vec3::Zero());
    };
    const std::vector<experiments::TimedTask> tasks{{"certified",
                                                     [&](std::size_t i) {
                                                       plain->search(pose(i), lmds, ignored);
                                                       sum_forces(lmds, scene.profile, Vec3::Zero());
                                                     }},
                                                    {"signed",
                                                     [&](std::size_t i) {
                                                       critical->find_critical(pose(i), set, ignored);
                                                       law(SIGNED);
                                                     }},
                                                    {"shared", [&](std::size_t i) {
                                                       merging->find_critical(pose(i), set, ignored);
                                                       merges.find(pose(i), set, found);
                                                       law(SHARED);
                                                     }}};
    std::array<std::vector<double>, 3> seconds;
    if (!coherent) {
      const auto times = experiments::time_interleaved(tasks, count, repetitions);
      for (std::size_t task = 0; task < tasks.size(); ++task) seconds[task] = times[task];
    } else {
      // Each runs along its own poses; they take turns frame by frame, so that all see one load.
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t task = 0; task < tasks.size(); ++task) {
          const std::size_t turn = (task + i) % tasks.size();
          const double begin = experiments::thread_seconds();
          tasks[turn].run(i);
          if (i > 0) seconds[turn].push_back(experiments::thread_seconds() - begin);
        }
    }
    rows.push_back({scene.name, coherent ? "coherent" : "from scratch", count, median(seconds[0]),
                    median(seconds[1]), median(seconds[2])});
  }
  return rows;
}

}  // namespace lmdbench::continuous_force
