// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace lmdbench {

/// An array whose entries do not move when it grows: moving ten thousands makes a frame three times
/// as long, and pairs in piles have no memory for spare room.
template <class T>
class SteadyArray {
 public:
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return chunks_.size() * CHUNK; }
  T& operator[](std::size_t i) { return chunks_[i / CHUNK][i % CHUNK]; }
  const T& operator[](std::size_t i) const { return chunks_[i / CHUNK][i % CHUNK]; }
  void push_back(const T& entry) {
    if (size_ == capacity()) chunks_.push_back(std::make_unique_for_overwrite<T[]>(CHUNK));
    (*this)[size_++] = entry;
  }

 private:
  static constexpr std::size_t CHUNK = 32;
  std::vector<std::unique_ptr<T[]>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace lmdbench
