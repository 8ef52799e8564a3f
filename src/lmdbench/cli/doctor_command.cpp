// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/comparison/machine_health.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

constexpr double NOISE_SECONDS = 5.0;

std::string doctor_json(const std::vector<HealthFinding>& findings, const NoiseFloor& noise) {
  nlohmann::ordered_json json{{"findings", nlohmann::ordered_json::array()}};
  for (const HealthFinding& f : findings)
    json["findings"].push_back({{"name", f.name},
                                {"health", health_name(f.health)},
                                {"value", f.value},
                                {"why", f.why},
                                {"remedy", f.remedy}});
  json["noise"] = {{"seconds", noise.seconds},
                   {"piece_s", noise.piece_seconds},
                   {"typical_excess", noise.typical_excess},
                   {"slow_excess", noise.slow_excess},
                   {"spread", noise.spread},
                   {"detectable", noise.detectable},
                   {"processes", noise.processes}};
  return json.dump(2);
}

std::string doctor_text(const std::vector<HealthFinding>& findings, const NoiseFloor& noise) {
  std::string text;
  for (const HealthFinding& f : findings) {
    text += fmt::format("{:<8} {}: {}\n", health_name(f.health), f.name, f.value);
    if (f.health != Health::GOOD) text += fmt::format("         {}; remedy: {}\n", f.why, f.remedy);
  }
  constexpr double PERCENT = 100.0;
  text += fmt::format(
      "noise    {:.1f} s of equal pieces of {:.0f} us: the median piece takes {:.1f} % longer than the "
      "fastest one, one "
      "in a hundred {:.0f} %\n",
      noise.seconds, noise.piece_seconds * 1e6, noise.typical_excess * PERCENT, noise.slow_excess * PERCENT);
  text += fmt::format(
      "         with the least of a few repetitions {:.2f} % are left from run to run: {} processes a side "
      "would show "
      "changes of {:.1f} % and more\n",
      noise.spread * PERCENT, noise.processes, noise.detectable * PERCENT);
  return text;
}

}  // namespace

void add_doctor_command(CLI::App& app, int& exit_status) {
  auto* command =
      app.add_subcommand("doctor", "Say what makes timings on this machine unreliable, and the remedies");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "findings and noise floor as JSON");
  command->footer("Exit codes: 0 nothing is bad; 1 something is, and timings here are unreliable.");
  command->callback([json, &exit_status] {
    const std::vector<HealthFinding> findings = judge_machine(machine_facts());
    spdlog::info("measuring the noise for {:g} s", NOISE_SECONDS);
    const NoiseFloor noise = measure_noise_floor(NOISE_SECONDS);
    fmt::print("{}{}", *json ? doctor_json(findings, noise) : doctor_text(findings, noise),
               *json ? "\n" : "");
    const bool bad = std::any_of(findings.begin(), findings.end(),
                                 [](const HealthFinding& finding) { return finding.health == Health::BAD; });
    if (bad) exit_status = static_cast<int>(ExitCode::CHECK_FAILED);
  });
}

}  // namespace lmdbench
