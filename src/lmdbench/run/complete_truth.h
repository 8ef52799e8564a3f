// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/run/records.h>
#include <lmdbench/run/truth_probe.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The truth of every frame, where a method that finds the complete set in every frame ran along: what changes from a frame to
/// the next is rare, and a probe on a stride sees hardly any of it. The probe's exhaustive sets, which share no search code with
/// the method, say whether its sets stand.
namespace lmdbench {

struct CompleteTruth {
  std::string label;  ///< Of the method.
  ForcesByLaw force;  ///< Rendered, one a frame under each law [N].
  std::vector<std::int64_t> lmd_count;
};

/// A method's record and what the probe found of it.
struct ProbedRecord {
  const MethodRecord* record = nullptr;
  const std::vector<TruthComparison>* probed = nullptr;
};

/// The first by label of the methods that kept forces under both laws (MethodRecord::force_by_law), if the probe looked at some
/// frames and its set was the exhaustive one in all of them.
/// @param candidates methods that share poses and profile
std::optional<CompleteTruth> complete_truth(std::vector<ProbedRecord> candidates);

}  // namespace lmdbench
