// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

namespace lmdbench {

const MethodDescription& exhaustive_method() {
  using Counter = Exhaustive::Counter;
  static const MethodDescription description{
      .name = "exhaustive",
      .summary = "ground truth: every triangle pair near enough, judged by the definition of an LMD",
      .promise = Promise::COMPLETE_SET,
      .tracks_locally = false,
      .trackings_after_search = 0,
      .brute_force = true,
      .counters = {{Counter::LEAF_PAIRS, "leaf_pairs", "triangle pairs whose boxes are near enough",
                    CountedBy::SEARCH},
                   {Counter::REJECTED_CUTOFF, "rejected_cutoff", "triangle pairs beyond the cutoff",
                    CountedBy::SEARCH},
                   {Counter::TRIANGLE_DISTANCES, "triangle_distances", "exact triangle distances",
                    CountedBy::SEARCH},
                   {Counter::FIRST_ORDER_TESTS, "first_order_tests",
                    "first-order tests of the definition of an LMD", CountedBy::SEARCH}},
      .make = [](const Scene& scene, const nlohmann::json&) -> std::unique_ptr<Method> {
        return std::make_unique<Exhaustive>(scene);
      }};
  return description;
}

}  // namespace lmdbench
