// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/methods/leaf_cones_option.h>
#include <lmdbench/methods/original/original.h>

namespace lmdbench {

NLOHMANN_JSON_SERIALIZE_ENUM(LineCone,
                             {{LineCone::ONE_SIDED, "one-sided"}, {LineCone::TWO_SIDED, "two-sided"}})
NLOHMANN_JSON_SERIALIZE_ENUM(FaceNeighbourhood, {{FaceNeighbourhood::OWN, "own"},
                                                 {FaceNeighbourhood::EDGE_NEIGHBOURS, "edge-neighbours"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OriginalOptions, g5_tolerance_deg, line_cone, face_neighbourhood,
                                   feature_points, leaf_cones, merge_duplicates, literal_g3)

const MethodDescription& original_method() {
  using Counter = Original::Counter;
  static const MethodDescription description{
      .name = "original",
      .summary =
          "Johnson's algorithm: least of 7x7 feature point distances, a search now and then, local tracking "
          "between",
      .promise = Promise::APPROXIMATION,
      .tracks_locally = true,
      .trackings_after_search = 0,
      .options = with_defaults(
          {{"g5_tolerance_deg",
            {{"type", "number"},
             {"minimum", 0},
             {"maximum", 180},
             {"description",
              "how far the direction of a 7x7 pair may leave the normals of its feature, in degrees (0.3 "
              "radian by "
              "default: the best of the sweep for the original)"}}},
           {"line_cone",
            {{"enum", {LineCone::ONE_SIDED, LineCone::TWO_SIDED}},
             {"description", "whether the dual solution-line cone is a ray or a line"}}},
           {"face_neighbourhood",
            {{"enum", {FaceNeighbourhood::OWN, FaceNeighbourhood::EDGE_NEIGHBOURS}},
             {"description",
              "where tracking looks from a point inside a triangle (Fig. 5 (a)): the triangle alone, or the "
              "three "
              "across its edges as well"}}},
           {"feature_points",
            {{"enum", {3, 7, 13, 25}},
             {"description",
              "points that stand for a triangle: its corners; also edge midpoints and centre (the paper's); "
              "three "
              "points an edge; five and a smaller triangle inside"}}},
           {"leaf_cones", leaf_cones_schema()},
           {"merge_duplicates",
            {{"type", "boolean"},
             {"description", "whether LMDs with the same pair of feature points are one (decision E13)"}}},
           {"literal_g3",
            {{"type", "boolean"},
             {"description",
              "ablation: read the inequality of G3 as printed; line_cone says nothing then"}}}},
          OriginalOptions{}),
      .counters = traversal_counters_and<Counter>(
          {{Counter::LEAF_PAIRS, "leaf_pairs", "triangle pairs that reached the leaf tests",
            CountedBy::SEARCH},
           {Counter::REJECTED_CUTOFF, "rejected_cutoff", "leaf pairs beyond the cutoff", CountedBy::SEARCH},
           {Counter::REJECTED_G5, "rejected_g5", "leaf pairs culled by direction verification",
            CountedBy::SEARCH},
           {Counter::FEATURE_POINT_DISTANCES, "feature_point_distances", "point distances of the 7x7 test",
            CountedBy::BOTH},
           {Counter::TRACKING_STEPS, "tracking_steps", "rounds of L1 to L4", CountedBy::TRACKING},
           {Counter::DROPPED_DUPLICATES, "dropped_duplicates", "LMDs dropped as duplicates",
            CountedBy::BOTH}}),
      .make = [](const Scene& scene, const nlohmann::json& options) -> std::unique_ptr<Method> {
        return std::make_unique<Original>(scene, options.get<OriginalOptions>());
      }};
  return description;
}

}  // namespace lmdbench
