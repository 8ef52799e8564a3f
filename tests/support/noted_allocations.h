// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

/// Replaces operator new and delete; include it in one file of a test program, which defines this:
namespace lmdbench::testing {

/// Called at every allocation, in the thread that makes it.
void note_allocation();

inline void* noted_allocation(std::size_t size, std::size_t alignment) {
  note_allocation();
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace lmdbench::testing

void* operator new(std::size_t size) {
  return lmdbench::testing::noted_allocation(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return lmdbench::testing::noted_allocation(size, static_cast<std::size_t>(alignment));
}
// The sanitizers have a form of their own, whose memory this delete must not get.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return lmdbench::testing::noted_allocation(size, alignof(std::max_align_t));
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
