// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_clock.h>

#include <dlfcn.h>
#include <pthread.h>
#include <realtime/counted_calls.h>
#include <support/noted_allocations.h>

#include <atomic>
#include <cstdint>

namespace {

std::atomic<std::int64_t> allocations_in_ticks{0}, locks_in_ticks{0};

}  // namespace

void lmdbench::testing::note_allocation() {
  if (in_servo_tick) ++allocations_in_ticks;
}

#ifndef __SANITIZE_THREAD__
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto real = reinterpret_cast<Lock>(::dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  if (lmdbench::in_servo_tick) ++locks_in_ticks;
  return real(mutex);
}
#endif

namespace lmdbench::testing {

CountedCalls counted_calls() {
  return {allocations_in_ticks, locks_in_ticks};
}

void reset_counted_calls() {
  allocations_in_ticks = 0;
  locks_in_ticks = 0;
}

}  // namespace lmdbench::testing
