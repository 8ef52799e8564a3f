// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace lmdbench {

/// Frames of a way there and back until there are so many.
template <typename Frame>
void there_and_back(std::vector<Frame>& frames, std::size_t wanted) {
  const std::size_t way = frames.size() - 1;
  frames.reserve(wanted);
  for (std::size_t i = frames.size(); i < wanted; ++i) {
    const std::size_t turn = way == 0 ? 0 : i % (2 * way);
    frames.push_back(frames[turn <= way ? turn : 2 * way - turn]);
  }
  frames.resize(wanted);
}

}  // namespace lmdbench
