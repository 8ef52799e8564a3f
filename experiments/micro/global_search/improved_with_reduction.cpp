// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

/// The improved algorithm's search and the first reduction (paper, section 4.3).
SearchImplementation improved_search_with_reduction() {
  return {"improved+reduction", Exactness::APPROXIMATE, false,
          [](const Scene& scene) { return make_method_search("improved", scene, 1); }};
}

}  // namespace lmdbench::micro
