// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lmdbench {

/// Groups of pairs of features. Two pairs that share a corner on the moving and a corner on the
/// fixed mesh are in one group, also over several such steps. The work is proportional to the
/// number of pairs; a comparison of all pairs at a corner would be quadratic.
class CornerGroups {
 public:
  /// @param count of pairs, named 0 to count - 1; each starts as a group of its own
  explicit CornerGroups(std::size_t count) : parents_(count) {
    for (std::size_t i = 0; i < count; ++i) parents_[i] = static_cast<std::uint32_t>(i);
    resize_table(std::bit_ceil(8 * count + 8));
  }

  /// Joins a pair with all that have been added before and share corners with it.
  void add(std::size_t pair, std::span<const std::int32_t> corners_moving,
           std::span<const std::int32_t> corners_fixed) {
    if (2 * (used_ + corners_moving.size() * corners_fixed.size()) > keys_.size()) grow();
    std::size_t group = group_of(pair);
    for (const std::int32_t m : corners_moving)
      for (const std::int32_t f : corners_fixed) {
        const std::uint64_t key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(m)) + 1) << 32 |
                                  static_cast<std::uint32_t>(f);
        const std::size_t slot = slot_of(key);
        if (keys_[slot] != key) {
          keys_[slot] = key;
          ++used_;
        } else if (pairs_[slot] != group) {
          group = join(group, group_of(pairs_[slot]));
        }
        pairs_[slot] = static_cast<std::uint32_t>(group);
      }
  }

  /// Pairs added from now on share no corner with earlier ones: they are of another fixed mesh.
  void forget_corners() {
    std::fill(keys_.begin(), keys_.end(), 0);
    used_ = 0;
  }

  /// The group's name: its first pair.
  std::size_t group_of(std::size_t pair) {
    while (parents_[pair] != pair) pair = parents_[pair] = parents_[parents_[pair]];
    return pair;
  }

 private:
  /// @return the name of both together
  std::size_t join(std::size_t group_a, std::size_t group_b) {
    const std::size_t first = std::min(group_a, group_b);
    parents_[std::max(group_a, group_b)] = static_cast<std::uint32_t>(first);
    return first;
  }
  /// Slot of the key, or its empty one (open addressing; multiplicative hashing, Knuth 6.4).
  std::size_t slot_of(std::uint64_t key) const {
    std::size_t slot = (key * 0x9E3779B97F4A7C15U) >> shift_;
    while (keys_[slot] != 0 && keys_[slot] != key) slot = (slot + 1) & (keys_.size() - 1);
    return slot;
  }
  void resize_table(std::size_t size) {
    keys_.assign(size, 0);
    pairs_.resize(size);
    shift_ = 64 - std::countr_zero(size);
  }
  void grow() {
    const std::vector<std::uint64_t> keys = std::move(keys_);
    const std::vector<std::uint32_t> pairs = std::move(pairs_);
    resize_table(2 * keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (keys[i] == 0) continue;
      const std::size_t slot = slot_of(keys[i]);
      keys_[slot] = keys[i];
      pairs_[slot] = pairs[i];
    }
  }

  std::vector<std::uint32_t> parents_;  ///< Never greater than the pair itself.
  std::vector<std::uint64_t> keys_;     ///< A corner of each mesh; 0: empty.
  std::vector<std::uint32_t> pairs_;    ///< A pair of the group that has these corners.
  std::size_t used_ = 0;
  int shift_ = 0;
};

}  // namespace lmdbench
