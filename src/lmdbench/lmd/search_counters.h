// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/work_counters.h>
#include <lmdbench/snch/traversal.h>

namespace lmdbench {

/// Adds what a traversal of the hierarchies did to a method's counters.
inline void add_traversal(WorkCounters& counters, const TraversalCounters& traversal) {
  counters[Counter::NODE_PAIRS] += traversal.node_pairs;
  counters[Counter::REJECTED_G1] += traversal.rejected_g1;
  counters[Counter::REJECTED_G2] += traversal.rejected_g2;
  counters[Counter::REJECTED_G3] += traversal.rejected_g3;
  counters[Counter::LEAF_PAIRS] += traversal.leaf_pairs;
}

}  // namespace lmdbench
