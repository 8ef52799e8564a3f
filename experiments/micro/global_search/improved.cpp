// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

/// The improved algorithm's base search, before the first reduction.
SearchImplementation improved_search() {
  return {"improved", Exactness::APPROXIMATE, false,
          [](const Scene& scene) { return make_method_search("improved", scene, 0); }};
}

}  // namespace lmdbench::micro
