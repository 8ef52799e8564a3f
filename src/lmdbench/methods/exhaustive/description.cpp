// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

namespace lmdbench {

const MethodDescription& exhaustive_method() {
  using Counter = Exhaustive::Counter;
  static const MethodDescription description{
      .name = "exhaustive",
      .summary = "ground truth: the definition of an LMD, asked for every pair of features near enough",
      .promise = Promise::COMPLETE_SET,
      .tracks_locally = false,
      .trackings_after_search = 0,
      .brute_force = true,
      .finds_critical_pairs = true,
      .counters = {{Counter::FEATURE_PAIRS, "feature_pairs", "pairs of features whose boxes are near enough",
                    CountedBy::SEARCH},
                   {Counter::CONTACTS, "contacts", "contacts that pairs of features have", CountedBy::SEARCH},
                   {Counter::TRIANGLE_DISTANCES, "triangle_distances",
                    "exact distances of triangles whose boxes overlap", CountedBy::SEARCH}},
      .make = [](const Scene& scene, const nlohmann::json&) -> std::unique_ptr<Method> {
        return std::make_unique<Exhaustive>(scene);
      }};
  return description;
}

}  // namespace lmdbench
