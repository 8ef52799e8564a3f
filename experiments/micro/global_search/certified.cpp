// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

/// The exact and complete method. Along a path it reuses the last frame's work; random
/// poses leave nothing to reuse.
SearchImplementation certified_search() {
  return {"certified", Exactness::COMPLETE_SET, false,
          [](const Scene& scene) { return make_method_search("certified", scene, 0); }};
}

/// The same without frame coherence: every frame from scratch.
SearchImplementation certified_search_from_scratch() {
  return {"certified-from-scratch", Exactness::COMPLETE_SET, false, [](const Scene& scene) {
            MethodOptions options;
            options.frame_coherence = false;
            return make_method_search("certified", scene, 0, options);
          }};
}

}  // namespace lmdbench::micro
