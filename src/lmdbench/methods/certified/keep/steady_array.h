// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace lmdbench {

/// An array whose entries do not move when it grows, but for the first few: moving ten thousands
/// makes a frame three times as long, and pairs in piles have no memory for spare room.
template <class T>
class SteadyArray {
 public:
  std::size_t size() const {
    return chunks_.empty() ? 0 : (chunks_.size() - 1) * CHUNK + chunks_.back().size();
  }
  T& operator[](std::size_t i) { return chunks_[i / CHUNK][i % CHUNK]; }
  const T& operator[](std::size_t i) const { return chunks_[i / CHUNK][i % CHUNK]; }
  void push_back(const T& entry) {
    if (size() == chunks_.size() * CHUNK) chunks_.emplace_back().reserve(chunks_.size() == 1 ? FIRST : CHUNK);
    chunks_.back().push_back(entry);
  }

 private:
  static constexpr std::size_t CHUNK = 256, FIRST = 16;
  std::vector<std::vector<T>> chunks_;  ///< Full but for the last one.
};

}  // namespace lmdbench
