// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

namespace lmdbench::micro {

std::vector<SearchImplementation> search_implementations() {
  std::vector<SearchImplementation> all = {original_search(),
                                           improved_search(),
                                           improved_search_with_reduction(),
                                           certified_search(),
                                           certified_search_from_scratch(),
                                           exhaustive_search(),
                                           fcl_cold_search(),
                                           fcl_warm_search()};
#ifdef LMDBENCH_HAS_EMBREE
  all.push_back(embree_search());
#endif
  return all;
}

}  // namespace lmdbench::micro
