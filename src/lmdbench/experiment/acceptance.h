// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

struct Experiment;

/// "limits" of an experiment file: bounds that a run must keep.
struct Acceptance {
  bool asked = false;                             ///< The file has limits.
  std::vector<std::string> methods;               ///< Labels; empty: all.
  std::optional<double> recall;                   ///< At least.
  std::optional<double> force_error_n;            ///< At most, over the probed frames.
  std::optional<std::int64_t> fcl_disagreements;  ///< At most, frames.
  std::optional<std::int64_t> late_frames;        ///< At most, frames in contact above 1 ms.
};

/// @param experiment with its methods and probes
/// @throws UsageError for a label that no method has and for a limit on what is not measured
Acceptance read_acceptance(const nlohmann::json& entry, const Experiment& experiment,
                           const std::string& file);

}  // namespace lmdbench
