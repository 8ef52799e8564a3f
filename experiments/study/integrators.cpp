// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/phantom/simulated_device.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <study/studies.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Error against run time of the integrators that carry the simulated device from tick to tick, as a table in Markdown.
/// A second of closed loop on a spring of one axis. The reference is the exact integration, which is good to rounding:
/// more than 1e4 times better than any other here; its own row shows time alone. With Coulomb friction the others solve a smoothed
/// equation (`phantom/odeint_integrators.h`), so their error holds what smoothing changes. Integrators take turns, so
/// that drifts of the machine's speed hit all alike.
namespace lmdbench::integrators {
namespace {

constexpr int TICKS = 1000;
constexpr double PERIOD = 1e-3;
constexpr int REPETITIONS = 7;

struct Case {
  std::string_view name;
  DeviceDynamics dynamics;
  double stiffness = 0.0;  ///< Of the spring that the loop renders [N/m].
};

std::vector<Case> cases() {
  return {{"soft contact, 100 N/m", {0.04, 0.8, 0.0, std::nullopt}, 100.0},
          {"hard contact, 1500 N/m", {0.04, 0.8, 0.0, std::nullopt}, 1500.0},
          {"arm with grip, 1500 N/m", {0.075, 0.005, 0.0, hand_named("speich-2005")}, 1500.0},
          {"stiff: damping 50 N s/m on 0.01 kg", {0.01, 50.0, 0.0, std::nullopt}, 1500.0},
          {"friction 0.06 N, 1500 N/m", {0.045, 0.8, 0.06, std::nullopt}, 1500.0}};
}

struct Outcome {
  std::vector<double> position;  ///< One a tick [m].
  double seconds = 0.0;          ///< Of all ticks.
  double residual = 0.0;         ///< Of the energy balance, relative to the energy moved.
};

Outcome move_through(const Case& which, Integration integration) {
  Outcome outcome;
  SimulatedDevice device(which.dynamics, integration, PERIOD, Vec3::Zero(), Vec3(1.0, 0.0, 0.0), 0.0);
  outcome.position.reserve(TICKS);
  const auto begin = std::chrono::steady_clock::now();
  for (int tick = 0; tick < TICKS; ++tick) {
    const double x = device.position().x();
    outcome.position.push_back(x);
    device.advance(Vec3(-which.stiffness * x, 0.0, 0.0), Vec3::Zero());
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  outcome.residual = device.energy().balance_error();
  return outcome;
}

/// Largest deviation over the run, relative to the largest excursion of the reference; infinite where it diverged.
double error(const Outcome& outcome, const Outcome& reference) {
  double excursion = 0.0;
  double deviation = 0.0;
  for (std::size_t i = 0; i < reference.position.size(); ++i) {
    excursion = std::max(excursion, std::abs(reference.position[i]));
    const double here = std::abs(outcome.position[i] - reference.position[i]);
    deviation = std::isfinite(here) ? std::max(deviation, here) : INFINITY;
  }
  return deviation / excursion;
}

void print_case(const Case& which) {
  const auto names = integration_names();
  const Outcome reference = move_through(which, Integration::EXACT);
  std::vector<std::vector<double>> microseconds(names.size());
  std::vector<Outcome> outcomes(names.size());
  for (int repetition = 0; repetition < REPETITIONS; ++repetition) {
    for (std::size_t turn = 0; turn < names.size(); ++turn) {
      const std::size_t i = repetition % 2 == 0 ? turn : names.size() - 1 - turn;
      outcomes[i] = move_through(which, static_cast<Integration>(i));
      microseconds[i].push_back(outcomes[i].seconds / TICKS * 1e6);
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    fmt::print("| {} | {} | {} | {:.1e} | {:.2f} |\n", which.name, names[i],
               i == 0 ? "reference" : fmt::format("{:.1e}", error(outcomes[i], reference)),
               outcomes[i].residual, median(microseconds[i]));
}

}  // namespace
}  // namespace lmdbench::integrators

void lmdbench::study::add_integrators(CLI::App& app, Run& chosen) {
  CLI::App* command =
      app.add_subcommand("integrators", "Error against run time of the integrators of the simulated device");
  command->callback([&chosen] {
    chosen.work = [] {
      fmt::print(
          "| case | integrator | error of position | energy left over | time a tick, us "
          "|\n|---|---|---|---|---|\n");
      for (const auto& which : integrators::cases()) integrators::print_case(which);
      return 0;
    };
  });
}
