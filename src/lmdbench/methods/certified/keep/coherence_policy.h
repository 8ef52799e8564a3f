// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lmdbench {

/// Tells whether it pays to keep a search from frame to frame. A kept test costs two to three fresh
/// ones; where two fifths are repeated in every frame (large motions) a search from scratch is as
/// cheap. Then nothing is kept for a while, longer each time. Work counters alone decide, so that
/// results and counters do not depend on the machine.
class CoherencePolicy {
 public:
  /// Whether this frame's search is to be kept. Called once a frame that could be kept.
  bool keep() {
    if (pause_ == 0) return true;
    --pause_;
    return false;
  }
  /// Repeating more of so many kept tests would cost more than a search from scratch.
  static std::size_t most_of(std::size_t kept) {
    return static_cast<std::size_t>(LARGEST_SHARE * static_cast<double>(kept));
  }
  /// After a frame that was kept.
  /// @param repeated tests that were made again
  /// @param kept     tests that are kept
  void note(std::size_t repeated, std::size_t kept) {
    repeated_ = MEMORY * repeated_ + static_cast<double>(repeated);
    kept_ = MEMORY * kept_ + static_cast<double>(kept);
    ++frames_;
    if (frames_ < LEAST_FRAMES || repeated_ <= LARGEST_SHARE * kept_) return;
    if (frames_ > FORGIVING_FRAMES) next_pause_ = FIRST_PAUSE;
    pause_ = next_pause_;
    next_pause_ = std::min(2 * next_pause_, LONGEST_PAUSE);
    repeated_ = kept_ = 0.0;
    frames_ = 0;
  }

 private:
  static constexpr double LARGEST_SHARE = 0.4;
  static constexpr double MEMORY = 0.7;
  /// Frames before which nothing is concluded, and after which earlier pauses are forgotten.
  static constexpr std::uint32_t LEAST_FRAMES = 3, FORGIVING_FRAMES = 100;
  static constexpr std::uint32_t FIRST_PAUSE = 8, LONGEST_PAUSE = 256;

  double repeated_ = 0.0, kept_ = 0.0;
  std::uint32_t frames_ = 0, pause_ = 0, next_pause_ = FIRST_PAUSE;
};

}  // namespace lmdbench
