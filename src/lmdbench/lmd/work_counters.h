// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lmdbench {

/// Deterministic cost of a method: exact, the same on every machine, so CI can gate on it.
enum class Counter : std::uint8_t {
  NODE_PAIRS,               ///< Node pairs tested by the dual traversal.
  REJECTED_G1,              ///< Node pairs beyond the cutoff.
  REJECTED_G2,              ///< Node pairs without collinear normals.
  REJECTED_G3,              ///< Node pairs whose cones miss the line of centres.
  LEAF_PAIRS,               ///< Triangle (or feature) pairs that reached the leaf tests.
  REJECTED_VISIBILITY,      ///< Leaf pairs culled by the visibility pre-test (improved).
  REJECTED_G5,              ///< Leaf pairs culled by direction verification (original).
  REJECTED_CUTOFF,          ///< Leaf pairs whose distance exceeds the cutoff.
  TRIANGLE_DISTANCES,       ///< Exact triangle-triangle distances.
  FEATURE_POINT_DISTANCES,  ///< Point-point distances of the 7x7 test.
  CACHE_HITS,               ///< Distances that the result cache saved (improved, section 4.2.1).
  TRACKING_STEPS,           ///< L1..L4 rounds.
  DROPPED_DUPLICATES,       ///< LMDs dropped as duplicates.
  FIRST_ORDER_TESTS,        ///< First-order LMD tests (exhaustive, certified).
  COUNT                     ///< Number of counters; not a counter.
};

inline constexpr std::size_t COUNTER_COUNT = static_cast<std::size_t>(Counter::COUNT);

/// Name in files and reports: "node_pairs", "rejected_g1", ...
std::string_view counter_name(Counter counter);

struct WorkCounters {
  std::array<std::uint64_t, COUNTER_COUNT> values{};

  std::uint64_t& operator[](Counter counter) { return values[static_cast<std::size_t>(counter)]; }
  std::uint64_t operator[](Counter counter) const { return values[static_cast<std::size_t>(counter)]; }
  WorkCounters& operator+=(const WorkCounters& other) {
    for (std::size_t i = 0; i < COUNTER_COUNT; ++i) values[i] += other.values[i];
    return *this;
  }
  bool operator==(const WorkCounters&) const = default;
};

}  // namespace lmdbench
