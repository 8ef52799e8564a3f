// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/methods/certified/certified.h>

namespace lmdbench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CertifiedOptions, frame_coherence)

const MethodDescription& certified_method() {
  using Counter = Certified::Counter;
  static const MethodDescription description{
      .name = "certified",
      .summary =
          "the exact and complete set in every frame: a wide hierarchy of features, tests kept while they "
          "stand",
      .promise = Promise::COMPLETE_SET,
      .tracks_locally = false,
      .trackings_after_search = 0,
      .options =
          with_defaults({{"frame_coherence",
                          {{"type", "boolean"},
                           {"description", "reuse the last frame's tests; the set is the same either way"}}}},
                        CertifiedOptions{}),
      .counters = traversal_counters_and<Counter>(
          {{Counter::LEAF_PAIRS, "leaf_pairs", "feature or triangle pairs that reached the leaf tests",
            CountedBy::SEARCH},
           {Counter::REJECTED_CUTOFF, "rejected_cutoff", "triangle pairs beyond the cutoff",
            CountedBy::SEARCH},
           {Counter::TRIANGLE_DISTANCES, "triangle_distances", "exact triangle distances", CountedBy::SEARCH},
           {Counter::FIRST_ORDER_TESTS, "first_order_tests", "first-order tests of the definition of an LMD",
            CountedBy::SEARCH}}),
      .make = [](const Scene& scene, const nlohmann::json& options) -> std::unique_ptr<Method> {
        return std::make_unique<Certified>(scene, options.get<CertifiedOptions>());
      }};
  return description;
}

}  // namespace lmdbench
