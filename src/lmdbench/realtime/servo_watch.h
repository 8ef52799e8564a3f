// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Whether the calling thread is inside a servo tick, where nothing may be allocated, locked, faulted in or written. The loop
/// sets it; tests that replace the allocator and the mutexes count what happens while it is set.
inline thread_local bool in_servo_tick = false;

/// Sets it for a scope.
class ServoWatch {
 public:
  ServoWatch() { in_servo_tick = true; }
  ~ServoWatch() { in_servo_tick = false; }
  ServoWatch(const ServoWatch&) = delete;
  ServoWatch& operator=(const ServoWatch&) = delete;
};

}  // namespace lmdbench
