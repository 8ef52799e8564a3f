// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lmdbench {

/// The result cache of the improved local tracking (paper, section 4.2.1): for each triangle pair
/// measured in this update its nearest points and features, and the LMD that initiated it. An
/// open-addressing table whose slots carry the update's number: emptying it in every haptic frame
/// costs nothing, and after warm-up nothing is allocated.
class ResultCache {
 public:
  struct Entry {
    Lmd lmd;
    std::int32_t initiator = -1;  ///< Number of the LMD that the distance was first calculated for.
  };

  ResultCache() : slots_(INITIAL_SLOTS) {}

  /// Forgets everything: the content is erased at the beginning of each local update.
  void erase() {
    ++update_;
    size_ = 0;
  }

  /// Returns the entry of a triangle pair and whether it was there; a new one is empty.
  std::pair<Entry*, bool> find_or_insert(std::int32_t t_moving, std::int32_t t_fixed) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[position(t_moving, t_fixed)];
    if (slot.update == update_) return {&slot.entry, true};
    slot = {update_, t_moving, t_fixed, {}};
    ++size_;
    return {&slot.entry, false};
  }

 private:
  static constexpr std::size_t INITIAL_SLOTS = 1024;  // a power of two

  struct Slot {
    std::uint64_t update = 0;
    std::int32_t t_moving = 0, t_fixed = 0;
    Entry entry;
  };

  /// Slot that holds the pair, or the free one where it belongs (linear probing).
  std::size_t position(std::int32_t t_moving, std::int32_t t_fixed) const {
    const std::uint64_t key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(t_moving)) << 32) ^
                              static_cast<std::uint32_t>(t_fixed);
    // Fibonacci hashing: 2^64 over the golden ratio spreads neighbouring indices.
    std::size_t i = (key * 0x9E3779B97F4A7C15ull) >> 32;
    for (;; ++i) {
      const Slot& slot = slots_[i & (slots_.size() - 1)];
      if (slot.update != update_ || (slot.t_moving == t_moving && slot.t_fixed == t_fixed))
        return i & (slots_.size() - 1);
    }
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.update == update_) slots_[position(slot.t_moving, slot.t_fixed)] = slot;
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
  std::uint64_t update_ = 1;
};

}  // namespace lmdbench
