// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

/// Ground truth itself, for its cost.
SearchImplementation exhaustive_search() {
  return {"exhaustive", Exactness::COMPLETE_SET, true,
          [](const Scene& scene) { return make_method_search("exhaustive", scene, 0); }};
}

}  // namespace lmdbench::micro
