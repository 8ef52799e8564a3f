// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// What makes timings on this machine unreliable, and what to do about it.
namespace lmdbench {

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
  std::string why;     ///< What it does to timings
  std::string remedy;  ///< What the user can do; empty where good
};

/// Facts by name: those of `machine_info` and, of this moment,
///   hardware_counters   "yes", or why not
///   smt_siblings        processors that share a core with one that this process may use: "none", or their numbers
///   cpu_quota           "none", or "share period" of the control group
///   stolen_share        share of processor time that the hypervisor gave to others since the machine started
using MachineFacts = std::map<std::string, std::string>;
MachineFacts machine_facts();

/// The findings in a fixed order; a fact that is missing or "unknown" makes an unknown finding.
std::vector<HealthFinding> judge_machine(const MachineFacts& facts);

}  // namespace lmdbench
