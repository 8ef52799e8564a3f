// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace lmdbench {

/// Hands the latest value from one thread to another without locks: a triple buffer. The writer
/// fills its slot and swaps its index with that of the slot in between; the reader does so when a
/// new value is there. Neither waits, no slot is read while written, and an unfetched value is
/// overwritten. One writer, one reader.
template <typename Value>
class LatestValue {
 public:
  /// Every slot starts as a copy of `initial`, so that its memory exists before the first tick.
  explicit LatestValue(const Value& initial = Value()) : slots_{initial, initial, initial} {}
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// The writer's slot, to be filled in place; it holds some earlier value.
  Value& slot() { return slots_[written_]; }
  /// Makes the slot's value the latest one.
  void publish() {
    written_ =
        between_.exchange(static_cast<std::uint8_t>(written_ | FRESH), std::memory_order_acq_rel) & INDEX;
  }

  /// Fetches the latest value, if it is new.
  /// @return whether it was
  bool fetch() {
    if ((between_.load(std::memory_order_relaxed) & FRESH) == 0) return false;
    read_ = between_.exchange(read_, std::memory_order_acq_rel) & INDEX;
    return true;
  }
  /// The last fetched value, at first the initial one.
  const Value& value() const { return slots_[read_]; }
  Value& value() { return slots_[read_]; }

 private:
  static constexpr std::uint8_t INDEX = 3;
  static constexpr std::uint8_t FRESH = 4;

  std::array<Value, 3> slots_;
  // Apart, so that neither thread's index shares a line of the cache with the other's.
  alignas(64) std::uint8_t written_ = 0;
  alignas(64) std::atomic<std::uint8_t> between_{1};
  alignas(64) std::uint8_t read_ = 2;
};

}  // namespace lmdbench
