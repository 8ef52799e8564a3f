// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Frames that a probe with this stride looks at: the multiples of the stride from `first` on, as long as the
/// next frame exists. Empty for stride 0.
/// @param first  for truth, the first frame in which a search can have arrived: no method on the two-rate
///               clock can know anything before
std::vector<std::int64_t> probed_frames(std::int64_t frame_count, std::int64_t stride,
                                        std::int64_t first = 0);

}  // namespace lmdbench
