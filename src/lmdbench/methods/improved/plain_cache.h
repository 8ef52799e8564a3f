// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/improved/result_cache.h>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace lmdbench {

/// The result cache on the standard library's map, as the paper, silent on it, may have it. Same
/// answers as `ResultCache`; shows the container's part of the reduction's time (claim K6).
class PlainCache {
 public:
  using Entry = ResultCache::Entry;

  void erase() { entries_.clear(); }

  /// As `ResultCache::find_or_insert`.
  std::pair<Entry*, bool> find_or_insert(std::int32_t t_moving, std::int32_t t_fixed) {
    const auto [place, is_new] = entries_.try_emplace(Key{t_moving, t_fixed});
    return {&place->second, !is_new};
  }

 private:
  using Key = std::pair<std::int32_t, std::int32_t>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return 31 * std::hash<std::int32_t>()(key.first) + std::hash<std::int32_t>()(key.second);
    }
  };
  std::unordered_map<Key, Entry, Hash> entries_;
};

}  // namespace lmdbench
