// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/whole_frame/implementation.h>

namespace lmdbench::micro {

std::vector<FrameImplementation> frame_implementations() {
  return {original_frame(),   improved_frame(), certified_whole_frame(), certified_from_scratch_frame(),
          exhaustive_frame(), fcl_cold_frame(), fcl_warm_frame()};
}

}  // namespace lmdbench::micro
