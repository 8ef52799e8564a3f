// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/method.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// The LMD set of one pose, from scratch.
struct QueryAnswer {
  double time = 0.0;  ///< Of the pose [s].
  std::string method;
  LmdSet lmds;                                                  ///< Sorted by `lmd_less`; world.
  std::optional<CriticalSet> critical;                          ///< If asked for; with the LMDs.
  std::vector<std::pair<std::string, std::uint64_t>> counters;  ///< The method's, by name.
  double seconds = 0.0;                                         ///< What the method took.
};

/// Searches at the pose; methods that track after a search (the improved algorithm's
/// reduction) do so at the same pose.
/// @param cutoff metres
/// @param time   of the pose, for the answer [s]
QueryAnswer query(Method& method, const Pose& X_WM, double cutoff, double time = 0.0);

/// The same with all critical pairs.
/// @pre the method's description says that it finds them
QueryAnswer query_critical(Method& method, const Pose& X_WM, double time = 0.0);

/// A line of JSON without line end (contract of `lmdbench query --json`). Distance 0 is a number;
/// an empty set has minimum distance null. Critical pairs are entries with "index" (or null) and
/// "minimum".
std::string query_json(const QueryAnswer& answer);

/// For people: a heading and one line an LMD.
std::string query_text(const QueryAnswer& answer);

}  // namespace lmdbench
