// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench::micro {

/// When a reported LMD counts as a true one.
enum class Match : std::uint8_t {
  FEATURE_PAIR,  ///< Same fixed body and same feature pair.
  ADJACENT       ///< Same fixed body, and on both sides the two features share an incident triangle.
};

/// Sums over poses; ratios are taken of sums, so that poses with many LMDs count for more.
struct MatchCount {
  std::size_t truths = 0;    ///< True LMDs.
  std::size_t found = 0;     ///< True LMDs that some reported one matches.
  std::size_t reported = 0;  ///< Distinct reported feature pairs.
  std::size_t right = 0;     ///< Distinct reported feature pairs that some true LMD matches.
  double recall() const;     ///< found / truths; NaN without truths.
  double precision() const;  ///< right / reported; NaN when nothing was reported.
  std::size_t missed() const { return truths - found; }
  MatchCount& operator+=(const MatchCount& other);
};

/// @param reported may hold a feature pair more than once (candidates before reduction): it counts once
MatchCount count_matches(const LmdSet& truth, const LmdSet& reported, Match match, const Scene& scene);

}  // namespace lmdbench::micro
