// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregate.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/merges.h>
#include <lmdbench/lmd/surface_samples.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What becomes of a set of contacts: one force and torque. A law is a file of laws/ and a line in aggregation.cpp.
namespace lmdbench {

/// What a law must know of a pose.
enum class AggregationNeeds : std::uint8_t {
  MINIMA,          ///< The LMDs.
  CRITICAL_PAIRS,  ///< All critical pairs with their indices: a method that finds them.
  MERGES,          ///< These, and which minima the saddles join.
  SURFACE          ///< These, and patches of the moving mesh's surface with their nearest points.
};

struct ForceInput {
  const CriticalSet& critical;               ///< Up to the profile's cutoff.
  std::span<const Merge> merges{};           ///< By the saddle's distance.
  std::span<const SurfaceSample> samples{};  ///< In any order.
  /// What one minimum weighs among patches of surface [m^2] (`layered`).
  double minimum_area = 0.0;
};

struct Aggregation {
  std::string_view name;     ///< In experiment files.
  std::string_view summary;  ///< One sentence without a full stop.
  AggregationNeeds needs;
  /// @param reference_W point about which the torque is taken
  Wrench (*combine)(const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W);
};

/// In the order of reports; the first is the default.
const std::vector<Aggregation>& aggregations();
std::vector<std::string> aggregation_names();

/// @throws UsageError for an unknown name, naming those that there are
const Aggregation& aggregation_named(std::string_view name, const std::string& file = "",
                                     const std::string& place = "aggregation");

// laws/
const Aggregation& sum_law();
const Aggregation& signed_law();
const Aggregation& shared_law();
const Aggregation& layered_law();

}  // namespace lmdbench
