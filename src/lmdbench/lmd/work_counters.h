// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lmdbench {

/// Deterministic cost of a method, the same on every machine, so CI can compare it. Its enumeration
/// says which value is which, `MethodDescription::counters` what they are called.
struct WorkCounters {
  /// No method has more counters; a fixed number keeps a frame's record free of allocations.
  static constexpr std::size_t CAPACITY = 16;

  std::array<std::uint64_t, CAPACITY> values{};

  template <class Counter>
  std::uint64_t& operator[](Counter counter) {
    static_assert(std::is_enum_v<Counter>, "counters are named by the method's enumeration");
    return values[static_cast<std::size_t>(counter)];
  }
  template <class Counter>
  std::uint64_t operator[](Counter counter) const {
    static_assert(std::is_enum_v<Counter>, "counters are named by the method's enumeration");
    return values[static_cast<std::size_t>(counter)];
  }
  WorkCounters& operator+=(const WorkCounters& other) {
    for (std::size_t i = 0; i < CAPACITY; ++i) values[i] += other.values[i];
    return *this;
  }
  bool operator==(const WorkCounters&) const = default;
};

}  // namespace lmdbench
