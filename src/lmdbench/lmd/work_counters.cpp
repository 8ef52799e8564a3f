// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/work_counters.h>

namespace lmdbench {

std::string_view counter_name(Counter counter) {
  switch (counter) {
    case Counter::NODE_PAIRS:
      return "node_pairs";
    case Counter::REJECTED_G1:
      return "rejected_g1";
    case Counter::REJECTED_G2:
      return "rejected_g2";
    case Counter::REJECTED_G3:
      return "rejected_g3";
    case Counter::LEAF_PAIRS:
      return "leaf_pairs";
    case Counter::REJECTED_VISIBILITY:
      return "rejected_visibility";
    case Counter::REJECTED_G5:
      return "rejected_g5";
    case Counter::REJECTED_CUTOFF:
      return "rejected_cutoff";
    case Counter::TRIANGLE_DISTANCES:
      return "triangle_distances";
    case Counter::FEATURE_POINT_DISTANCES:
      return "feature_point_distances";
    case Counter::CACHE_HITS:
      return "cache_hits";
    case Counter::TRACKING_STEPS:
      return "tracking_steps";
    case Counter::DROPPED_DUPLICATES:
      return "dropped_duplicates";
    case Counter::FIRST_ORDER_TESTS:
      return "first_order_tests";
    case Counter::COUNT:
      break;
  }
  return "unknown";
}

}  // namespace lmdbench
