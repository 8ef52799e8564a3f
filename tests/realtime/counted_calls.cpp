// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_watch.h>

#include <dlfcn.h>
#include <pthread.h>
#include <realtime/counted_calls.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> allocations_in_ticks{0}, locks_in_ticks{0};

void* counted_in_ticks(std::size_t size, std::size_t alignment) {
  if (lmdbench::in_servo_tick) ++allocations_in_ticks;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return counted_in_ticks(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted_in_ticks(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted_in_ticks(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
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
