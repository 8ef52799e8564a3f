// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmd/scene.h>

#include <study/completeness/nearest_lmd.h>

#include <optional>
#include <string>

namespace lmdbench::completeness {

/// Distances and points differ when they are farther apart than this, relative to the diagonal:
/// some thousand roundings of a coordinate.
inline constexpr double POSITION_TOLERANCE = 1e-12;

/// The same where triangles intersect: crossings are found to 1e-11 (certified/PROOF.md, lemma 11).
inline constexpr double CROSSING_TOLERANCE = 1e-11;

/// How far reported LMD sets are from the true ones, summed over poses.
struct Judgement {
  Agreement same;        ///< Same features.
  Agreement neighbours;  ///< Neighbouring features count.
  /// LMDs beyond the first of a feature pair, more than in the truth: parts of a chain over one
  /// face are LMDs of their own.
  std::size_t duplicates = 0;
  std::size_t poses = 0;
  std::size_t wrong_poses = 0;             ///< Poses with anything wrong.
  std::size_t nearest_asked = 0;           ///< Poses whose nearest pair has to be an LMD.
  double worst_distance_difference = 0.0;  ///< Over matched pairs, relative to the diagonal.
  double worst_point_difference = 0.0;     ///< The same for the points on both meshes.

  Judgement& operator+=(const Judgement& other);
};

/// Compares one pose's sets: distances and points to the tolerances, directions to the bit, as an
/// LMD is a function of its contacts. Each must be well formed (well_formed.h).
/// @param diagonal  scale of the differences [m]
/// @param objection receives the differences with features and distances; empty when there are none
/// @param nearest   what the least distance has to be; nothing where it is not asked
Judgement judge(const LmdSet& truth, const LmdSet& reported, const Scene& scene, double diagonal,
                std::string& objection, const std::optional<NearestLmd>& nearest = {});

}  // namespace lmdbench::completeness
