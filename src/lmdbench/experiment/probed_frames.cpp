// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/probed_frames.h>

namespace lmdbench {

std::vector<std::int64_t> probed_frames(std::int64_t frame_count, std::int64_t stride, std::int64_t first) {
  std::vector<std::int64_t> frames;
  if (stride <= 0) return frames;
  for (std::int64_t frame = 0; frame + 1 < frame_count; frame += stride)
    if (frame >= first) frames.push_back(frame);
  return frames;
}

}  // namespace lmdbench
