// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/hierarchy_build/implementation.h>

namespace lmdbench::experiments {

std::vector<BuildImplementation> build_implementations() {
  std::vector<BuildImplementation> all = {surface_build(), binary_hierarchy_build(), wide_hierarchy_build(),
                                          fcl_build()};
#ifdef LMDBENCH_HAS_EMBREE
  all.push_back(embree_build());
#endif
  return all;
}

}  // namespace lmdbench::experiments
