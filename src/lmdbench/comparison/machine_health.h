// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Repeatability of a fixed piece of work on this machine at this moment.
struct NoiseFloor {
  double seconds = 0.0;         ///< Duration of the measurement
  double piece_seconds = 0.0;   ///< Least time of one piece of work
  double typical_excess = 0.0;  ///< Median piece over the least one, less 1
  double slow_excess = 0.0;     ///< The same at the 99 % quantile
  /// Standard deviation of the logarithm of a process's `stage_times`: the noise that remains where
  /// every frame counts with the least time of its repetitions. Without effects of memory layout.
  double spread = 0.0;
  double detectable = 0.0;  ///< Least change that `processes` a side show; NaN: measured too little
  std::size_t processes = 0;
};

/// Takes the pieces of one measurement in the order run: groups of `repetitions` times `pieces`.
/// @param times (group, repetition, piece), row-major [s]; at least two groups
NoiseFloor summarise_noise(std::span<const double> times, std::size_t repetitions, std::size_t pieces);

/// Runs pieces of a fixed computation for about `seconds`; changes of lmdbench do not move it.
NoiseFloor measure_noise_floor(double seconds);

/// Causes of unreliable timings on this machine, and remedies.

enum class Health {
  GOOD,
  BAD,     ///< Makes timings unreliable
  UNKNOWN  ///< The system does not say
};

/// "good", "bad", "unknown"
std::string_view health_name(Health health);

struct HealthFinding {
  std::string name;  ///< "frequency governor"
  Health health = Health::UNKNOWN;
  std::string value;   ///< As the system says it
  std::string why;     ///< Effect on timings
  std::string remedy;  ///< What the user can do; empty where good
};

/// Facts by name: those of `machine_info` and, of this moment,
///   hardware_counters   "yes", or why not
///   smt_siblings        processors that share a core with a usable one: "none", or their numbers
///   cpu_quota           "none", or "share period" of the control group
///   stolen_share        share of processor time that the hypervisor gave to others since boot
using MachineFacts = std::map<std::string, std::string>;
MachineFacts machine_facts();

/// The findings in a fixed order; a fact that is missing or "unknown" makes an unknown finding.
std::vector<HealthFinding> judge_machine(const MachineFacts& facts);

}  // namespace lmdbench
