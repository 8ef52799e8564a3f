// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

/// The exact and complete method.
SearchImplementation certified_search() {
  return {"certified", Exactness::COMPLETE_SET, false,
          [](const Scene& scene) { return make_method_search("certified", scene, 0); }};
}

}  // namespace lmdbench::micro
