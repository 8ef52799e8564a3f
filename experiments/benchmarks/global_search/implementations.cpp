// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/global_search/implementation.h>

namespace lmdbench::experiments {

std::vector<SearchImplementation> search_implementations() {
  std::vector<SearchImplementation> all = method_searches();
  all.push_back(certified_search_from_scratch());
  all.push_back(fcl_cold_search());
  all.push_back(fcl_warm_search());
#ifdef LMDBENCH_HAS_EMBREE
  all.push_back(embree_search());
#endif
  return all;
}

}  // namespace lmdbench::experiments
