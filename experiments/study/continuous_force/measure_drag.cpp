// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/pose_source.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/metrics/cleanliness.h>
#include <lmdbench/prepare/prepare.h>

#include <study/continuous_force/measures.h>
#include <support/random.h>

#include <algorithm>
#include <cmath>

namespace lmdbench::continuous_force {

namespace {

constexpr double PUSH_N = 1.0, DRAG_M_PER_S = 0.03, PRESSED_S = 0.2, DRAG_SETTLED_S = 0.3, DRAG_S = 0.9;

}  // namespace

std::vector<DragRow> measure_drag(const std::filesystem::path& file, std::size_t spots, std::uint64_t seed,
                                  bool layered) {
  const Experiment experiment = load_experiment(file);
  const PreparedRun prepared = prepare(experiment);
  const double rate = experiment.frame_rate_hz, period = 1.0 / rate;
  const PreparedProfile& soft = prepared.profiles.back();
  ForceProfile profile = soft.force;
  profile.law = ForceLaw::LINEAR;
  profile.saturation_distance = 0.0;
  profile.maximum_force = 1.0;
  std::vector<DragRow> rows;
  for (const double stiffness : {300.0, 600.0, 1200.0, 2400.0}) {
    DragRow row{stiffness, 0, 0, zeros(layered), zeros(layered)};
    // The same spots and directions for every stiffness.
    experiments::Random random(seed);
    const double force_of_one = stiffness * profile.cutoff;
    while (row.spots < spots) {
      Renderer renderer(soft.scene, profile);
      Renderer with_layered(soft.scene, profile, LayeredChoice());
      const Pose& start = prepared.input.poses[random.index(prepared.input.poses.size())];
      const Vec3 side = random.direction();
      const Vec3 first = renderer.at(start).force[SHARED];
      if (!(first.norm() > 0.0)) continue;
      ++row.spots;
      const Vec3 press = -first.normalized() * PUSH_N / experiment.loop.dynamics.hand->stiffness_n_per_m;
      const Vec3 along = side.cross(press).normalized();
      std::vector<Pose> meant;
      for (std::size_t k = 0; k < static_cast<std::size_t>(DRAG_S * rate); ++k) {
        const double time = static_cast<double>(k) * period, s = std::min(1.0, time / PRESSED_S);
        Pose pose = start;
        pose.translation += s * s * (3.0 - 2.0 * s) * press + DRAG_M_PER_S * time * along;
        meant.push_back(pose);
      }
      bool through = false;
      std::array<double, LAWS> noise{}, jump{};
      for (std::size_t law = 0; law < LAWS; ++law) {
        if (law == LAYERED && !layered) continue;
        DevicePoses device(experiment.loop, meant, period, prepared.input.reference_M);
        std::vector<Vec3> forces;
        for (std::size_t k = 0; k < meant.size(); ++k) {
          const Rendered here = (law == LAYERED ? with_layered : renderer).at(device.pose());
          through = through || std::ranges::any_of(here.critical,
                                                   [](const CriticalPair& c) { return c.pair.intersecting; });
          RenderedForce rendered;
          rendered.force = force_of_one * here.force[law];
          forces.push_back(rendered.force);
          device.render(rendered);
        }
        const std::vector<Vec3> high = above_30_hz(forces, period);
        double square = 0.0, push = 0.0, largest = 0.0;
        const auto settled = static_cast<std::size_t>(DRAG_SETTLED_S * rate);
        for (std::size_t k = settled; k < forces.size(); ++k) {
          square += high[k].squaredNorm();
          push += forces[k].norm();
          largest = std::max(largest, (forces[k] - forces[k - 1]).norm());
        }
        const auto count = static_cast<double>(forces.size() - settled);
        push /= count;
        noise[law] = std::sqrt(square / count) / push;
        jump[law] = largest / push;
      }
      // Once the meshes touch under a law, its force tells nothing.
      if (through) {
        ++row.through;
        continue;
      }
      for (std::size_t law = 0; law < LAWS; ++law) {
        row.above_30_hz[law] += noise[law];
        row.largest_jump[law] += jump[law];
      }
    }
    const double clean = std::max<double>(1.0, static_cast<double>(row.spots - row.through));
    for (std::size_t law = 0; law < LAWS; ++law) {
      row.above_30_hz[law] /= clean;
      row.largest_jump[law] /= clean;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lmdbench::continuous_force
