// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/work_counters.h>

#include <vector>

namespace lmdbench {

/// Counts of methods that descend two hierarchies with the tests G1 to G3. `Counter` is the
/// method's enumeration, `Traversal` the descent's counts, with equal names.
template <class Counter, class Traversal>
void add_traversal(WorkCounters& counters, const Traversal& traversal) {
  counters[Counter::NODE_PAIRS] += traversal.node_pairs;
  counters[Counter::REJECTED_G1] += traversal.rejected_g1;
  counters[Counter::REJECTED_G2] += traversal.rejected_g2;
  counters[Counter::REJECTED_G3] += traversal.rejected_g3;
  if constexpr (requires { traversal.leaf_pairs; }) counters[Counter::LEAF_PAIRS] += traversal.leaf_pairs;
}

/// Their descriptions, followed by `more`.
template <class Counter>
std::vector<CounterDescription> traversal_counters_and(std::vector<CounterDescription> more) {
  std::vector<CounterDescription> all{
      {Counter::NODE_PAIRS, "node_pairs", "node pairs tested by the dual traversal", CountedBy::SEARCH},
      {Counter::REJECTED_G1, "rejected_g1", "node pairs beyond the cutoff", CountedBy::SEARCH},
      {Counter::REJECTED_G2, "rejected_g2", "node pairs without collinear normals", CountedBy::SEARCH},
      {Counter::REJECTED_G3, "rejected_g3", "node pairs whose cones miss the line of centres",
       CountedBy::SEARCH}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace lmdbench
