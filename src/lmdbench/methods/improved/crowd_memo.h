// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/local_tracking.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace lmdbench {

/// Triangle pairs of two neighbourhoods from which on they are a crowd. Two vertices of scanned or
/// remeshed surfaces have under 400, so the paper's algorithm keeps its cost there.
inline constexpr std::size_t CROWD_PAIRS = 1024;

/// Remembers, in one local update, results of walks round a pair of features in a crowd. Two hubs
/// of k triangles have k^2 pairs, and up to k^2 candidates walk there: k^4 looks. Each finds the
/// same: distances and initiators stay in an update.
class CrowdMemo {
 public:
  /// The shortest pair, and the LMDs for which its distance and ties were first calculated.
  struct Entry {
    Lmd lmd;
    std::int32_t initiator = -1;  ///< Of the shortest pair.
    bool several = false;         ///< Pairs that tie have other initiators.

    bool seen_by_other(std::int32_t number) const { return several || initiator != number; }
  };

  void erase() { entries_.clear(); }

  /// @param look () -> Entry, called where nothing is known yet
  /// @return the entry, and whether it was there
  template <class Look>
  std::pair<const Entry&, bool> find_or_look(const FeatureId& moving, const FeatureId& fixed, Look&& look) {
    const Key key{moving, fixed};
    if (const auto found = entries_.find(key); found != entries_.end()) return {found->second, true};
    return {entries_.emplace(key, look()).first->second, false};
  }

 private:
  using Key = std::pair<FeatureId, FeatureId>;
  std::map<Key, Entry> entries_;
};

}  // namespace lmdbench
