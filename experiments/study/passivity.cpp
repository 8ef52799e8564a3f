// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/passivity.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <study/studies.h>

/// Energy that a sampled wall generates, against theory, and limit cycles of quantisation: tables
/// in Markdown (theory: phantom/passivity.h).
namespace lmdbench::study {
namespace {

constexpr double WALL_PERIOD = 1e-3;
constexpr double DAMPING = 0.8;
constexpr double WAY = 1e-4;  ///< 0.1 m/s at 1 kHz.
constexpr int DEPTH = 50;
constexpr double COLGATE = 2.0 * DAMPING / WALL_PERIOD;

int tables() {
  fmt::print(
      "| K / (2 b / T) | gain a period, simulated, uJ | theory (K/2 - b/T) dx^2, uJ | with friction 0.03 N, "
      "uJ | with counts of "
      "0.023 mm, uJ |\n|---|---|---|---|---|\n");
  for (const double ratio : {0.25, 0.5, 0.9, 0.99, 1.0, 1.01, 1.1, 1.5, 2.0, 4.0}) {
    const auto gain = [&](double friction, double resolution) {
      const Excursion e =
          carry_through({ratio * COLGATE, WALL_PERIOD, resolution}, DAMPING, friction, WAY, DEPTH);
      return 1e6 * e.net_energy_j / static_cast<double>(e.periods);
    };
    fmt::print("| {:g} | {:.6f} | {:.6f} | {:.6f} | {:.6f} |\n", ratio, gain(0.0, 0.0),
               1e6 * (0.5 * ratio * COLGATE - DAMPING / WALL_PERIOD) * WAY * WAY, gain(0.03, 0.0),
               gain(0.0, 2.3e-5));
  }
  fmt::print(
      "\n| K / (2 b / T) | friction / (K d / 2) | amplitude, counts | frequency, Hz | power that it lives "
      "on, uW | what it is |\n"
      "|---|---|---|---|---|---|\n");
  constexpr double COUNT = 2.3e-5;
  for (const double ratio : {0.1, 0.5, 0.9}) {
    const SampledWall wall{ratio * COLGATE, WALL_PERIOD, COUNT};
    const double half_count_force = 0.5 * wall.stiffness_n_per_m * COUNT;
    for (const double share : {0.0, 0.1, 0.25, 0.5, 0.99, 1.01, 2.0}) {
      // The load lies midway between the forces of two counts: no equilibrium without friction.
      const double load = 20.5 * wall.stiffness_n_per_m * COUNT;
      const RestingSwing swing =
          rest_on(wall, {0.04, DAMPING, share * half_count_force, std::nullopt}, load, 0.01, 40000);
      fmt::print("| {:g} | {:g} | {:.3f} | {:.1f} | {:.4f} | {} |\n", ratio, share, swing.amplitude_m / COUNT,
                 swing.frequency_hz, 1e6 * swing.net_power_w,
                 swing.frequency_hz > 0.0 ? "limit cycle: hunts between two counts" : "at rest");
    }
  }
  return 0;
}

}  // namespace

void add_passivity(CLI::App& app, Run& chosen) {
  auto* command =
      app.add_subcommand("passivity", "Energy that a sampled wall gives, against theory; limit cycles");
  command->callback([&chosen] { chosen.work = tables; });
}

}  // namespace lmdbench::study
