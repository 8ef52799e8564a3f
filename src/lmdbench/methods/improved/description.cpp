// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/methods/improved/improved.h>
#include <lmdbench/methods/leaf_cones_option.h>

namespace lmdbench {

NLOHMANN_JSON_SERIALIZE_ENUM(Visibility, {{Visibility::VERTEX_NORMAL, "vertex-normal"},
                                          {Visibility::ORTHOGONAL, "orthogonal"},
                                          {Visibility::OFF, "off"}})
NLOHMANN_JSON_SERIALIZE_ENUM(Reduction,
                             {{Reduction::PUBLISHED, "published"}, {Reduction::LOSS_FREE, "loss-free"}})
NLOHMANN_JSON_SERIALIZE_ENUM(TrackingOrder, {{TrackingOrder::NEAREST_FIRST, "nearest-first"},
                                             {TrackingOrder::TRIANGLE_INDEX, "triangle-index"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ImprovedOptions, visibility, reduction, tracking_order, leaf_cones,
                                   second_tracking, plain_cache, literal_g3, search_threads, clamped_sigma)

const MethodDescription& improved_method() {
  using Counter = Improved::Counter;
  static const MethodDescription description{
      .name = "improved",
      .summary =
          "the paper's algorithm: exact triangle distances, visibility pre-test, result cache, reduction, "
          "local tracking",
      .promise = Promise::APPROXIMATION,
      .tracks_locally = true,
      .trackings_after_search = 2,
      .options = with_defaults(
          {{"visibility",
            {{"enum", {Visibility::VERTEX_NORMAL, Visibility::ORTHOGONAL, Visibility::OFF}},
             {"description", "how the visibility pre-test projects a triangle onto the other's plane"}}},
           {"reduction",
            {{"enum", {Reduction::PUBLISHED, Reduction::LOSS_FREE}},
             {"description", "which LMDs tracking drops"}}},
           {"tracking_order",
            {{"enum", {TrackingOrder::NEAREST_FIRST, TrackingOrder::TRIANGLE_INDEX}},
             {"description",
              "in which order tracking takes the LMDs of a set; what the published reduction drops depends "
              "on it"}}},
           {"leaf_cones", leaf_cones_schema()},
           {"second_tracking",
            {{"type", "boolean"},
             {"description",
              "whether a search's set is tracked again when it is handed over (section 4.3)"}}},
           {"plain_cache",
            {{"type", "boolean"},
             {"description", "ablation: the result cache is a std::unordered_map; the same answers"}}},
           {"literal_g3",
            {{"type", "boolean"},
             {"description",
              "ablation: read the inequality of G3 as printed; clamped_sigma says nothing then"}}},
           {"search_threads",
            {{"type", "integer"},
             {"minimum", 1},
             {"maximum", 64},
             {"description",
              "threads of the global search, its first levels shared out; the same sets in the same order"}}},
           {"clamped_sigma",
            {{"type", "boolean"},
             {"description",
              "ablation: G3 with a sigma of a right angle where spheres overlap (decision E3)"}}}},
          ImprovedOptions{}),
      .counters = traversal_counters_and<Counter>(
          {{Counter::LEAF_PAIRS, "leaf_pairs", "triangle pairs that reached the leaf tests",
            CountedBy::SEARCH},
           {Counter::REJECTED_VISIBILITY, "rejected_visibility",
            "leaf pairs culled by the visibility pre-test", CountedBy::SEARCH},
           {Counter::REJECTED_CUTOFF, "rejected_cutoff", "leaf pairs beyond the cutoff", CountedBy::SEARCH},
           {Counter::TRIANGLE_DISTANCES, "triangle_distances", "exact triangle distances", CountedBy::BOTH},
           {Counter::CACHE_HITS, "cache_hits", "triangle distances that the result cache saved",
            CountedBy::TRACKING},
           {Counter::TRACKING_STEPS, "tracking_steps", "rounds of L1 to L4", CountedBy::TRACKING},
           {Counter::DROPPED_DUPLICATES, "dropped_duplicates", "LMDs dropped as duplicates",
            CountedBy::TRACKING}}),
      .make = [](const Scene& scene, const nlohmann::json& options) -> std::unique_ptr<Method> {
        return std::make_unique<Improved>(scene, options.get<ImprovedOptions>());
      }};
  return description;
}

const MethodDescription& improved_method_tracking_once() {
  static const MethodDescription description = [] {
    MethodDescription once = improved_method();
    once.trackings_after_search = 1;
    return once;
  }();
  return description;
}

}  // namespace lmdbench
