// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/nearest/nearest.h>

namespace lmdbench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NearestOptions, warm_start)

const MethodDescription& nearest_method() {
  using Counter = Nearest::Counter;
  static const MethodDescription description{
      .name = "nearest",
      .summary = "one contact a frame: FCL's nearest pair of the meshes, begun with the last frame's",
      .promise = Promise::NEAREST_PAIR,
      .options = with_defaults(
          {{"warm_start",
            {{"type", "boolean"},
             {"description", "begin each search with the bound that the last frame's pair gives"}}}},
          NearestOptions{}),
      .counters = {{Counter::FCL_QUERIES, "fcl_queries", "distance queries of FCL", CountedBy::SEARCH},
                   {Counter::TRIANGLE_DISTANCES, "triangle_distances",
                    "exact triangle distances, for the features of the pair", CountedBy::SEARCH}},
      .make = [](const Scene& scene, const nlohmann::json& options) -> std::unique_ptr<Method> {
        return std::make_unique<Nearest>(scene, options.get<NearestOptions>());
      }};
  return description;
}

}  // namespace lmdbench
