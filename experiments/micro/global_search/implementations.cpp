// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/global_search/implementation.h>

#include <algorithm>

namespace lmdbench::micro {

std::vector<SearchImplementation> search_implementations() {
  std::vector<SearchImplementation> known = {
      original_search(),  improved_search(),   improved_search_with_reduction(),
      certified_search(), exhaustive_search(), fcl_cold_search(),
      fcl_warm_search()};
  // A build may lack a method; its name is that of its implementation.
  std::erase_if(known, [](const SearchImplementation& implementation) {
    return implementation.name == "certified" && std::find(method_names().begin(), method_names().end(),
                                                           implementation.name) == method_names().end();
  });
  return known;
}

}  // namespace lmdbench::micro
