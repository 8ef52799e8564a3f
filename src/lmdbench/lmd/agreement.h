// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>

/// How well LMD sets agree with the true ones: recall and precision, for runs, studies and
/// benchmarks alike.
namespace lmdbench {

/// When a reported LMD counts as a true one.
enum class Match : std::uint8_t {
  /// Same feature pair and fixed body, one to one: a duplicate is false (it doubles the force).
  SAME_FEATURES,
  /// Same fixed body, and on both meshes the two features share an incident triangle: a pair one
  /// feature from its minimum counts. Not one to one: neighbours may share a partner.
  NEIGHBOURING_FEATURES
};

/// Counts, summed over poses or frames before a ratio is taken ("pooled"), so that a frame with one
/// LMD weighs less than one with twenty.
struct Agreement {
  std::size_t true_lmds = 0;
  std::size_t found = 0;  ///< True LMDs that a reported one matches.
  std::size_t reported = 0;
  std::size_t right = 0;  ///< Reported LMDs that a true one matches.

  double recall() const;     ///< found / true_lmds; NaN where there is no true LMD.
  double precision() const;  ///< right / reported; NaN where nothing was reported.
  std::size_t missed() const { return true_lmds - found; }
  std::size_t wrong() const { return reported - right; }
  /// Whether nothing is missed and nothing wrong. Says "the true set" only for SAME_FEATURES.
  bool exact() const { return missed() == 0 && wrong() == 0; }
  Agreement& operator+=(const Agreement& other);
};

/// Compares the sets of one pose.
/// @param scene whose features the LMDs name
Agreement agreement(const LmdSet& truth, const LmdSet& reported, Match match, const Scene& scene);

/// The set with each feature pair once; candidates before the reduction hold one for each triangle
/// pair that found it.
LmdSet distinct_pairs(LmdSet lmds);

}  // namespace lmdbench
