// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/critical/merges.h>
#include <lmdbench/critical/surface_samples.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Force and torque that the fixed meshes exert on the moving one, in the world frame.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< newtons
  Vec3 torque = Vec3::Zero();  ///< newton metres, about the reference point
  /// K_eff [N/m]: slope -d|force|/dx for a translation x along the force, u^T (sum_i k_i n_i n_i^T)
  /// u, u along the force, n_i an LMD's direction (held fixed, as in a flat contact), k_i its
  /// stiffness. n equal LMDs give n k, which clipping the force does not bound. If forces cancel:
  /// the stiffest direction's.
  double stiffness = 0.0;
};

/// Sums the LMDs' forces (paper, section 4.5): each pushes the moving mesh along -direction with
/// `force_magnitude`. LMDs beyond the cutoff or without direction (E12) add nothing. Not clipped:
/// that is the device's part (`phantom/`). Summed in the set's order: sorted sets give the same
/// bits.
/// @param reference_W point about which the torque is taken
Wrench sum_forces(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W);

// A law combines contacts into one force and torque: a file of laws/ and a line in aggregation.cpp.

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
  /// What each minimum weighs among patches of surface [m^2] (`layered`), by critical pair.
  std::span<const double> minimum_areas{};
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
