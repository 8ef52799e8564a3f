// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/critical_pair.h>

#include <algorithm>

namespace lmdbench {

LmdSet minima_of(const CriticalSet& set) {
  LMDBENCH_EXPECTS(std::ranges::is_sorted(set, lmd_less, &CriticalPair::pair),
                   "a set that was not sorted (finish_critical)");
  LmdSet minima;
  for (const CriticalPair& critical : set)
    if (critical.is_minimum) minima.push_back(critical.pair);
  return minima;
}

int sum_of_indices(const CriticalSet& set) {
  int sum = 0;
  for (const CriticalPair& critical : set) sum += critical.index;
  return sum;
}

void sort_critical(CriticalSet& set) {
  std::ranges::stable_sort(
      set, [](const CriticalPair& a, const CriticalPair& b) { return lmd_less(a.pair, b.pair); });
}

}  // namespace lmdbench
