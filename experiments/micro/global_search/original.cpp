// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

/// The original algorithm's search: no tracking follows it in the global thread.
SearchImplementation original_search() {
  return {"original", Exactness::APPROXIMATE, false,
          [](const Scene& scene) { return make_method_search("original", scene, 0); }};
}

}  // namespace lmdbench::micro
