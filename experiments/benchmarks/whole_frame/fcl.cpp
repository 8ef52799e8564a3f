// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/whole_frame/implementation.h>

namespace lmdbench::experiments {

/// The nearest pair only, every frame from scratch.
FrameImplementation fcl_cold_frame() {
  return rendered_search(fcl_cold_search());
}

/// The nearest pair only, seeded with the last frame's.
FrameImplementation fcl_warm_frame() {
  return rendered_search(fcl_warm_search());
}

}  // namespace lmdbench::experiments
