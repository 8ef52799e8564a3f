// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/methods/certified/certified.h>

namespace lmdbench {

NLOHMANN_JSON_SERIALIZE_ENUM(VectorTarget, {{VectorTarget::BEST, "best"},
                                            {VectorTarget::AVX512, "avx512"},
                                            {VectorTarget::AVX2, "avx2"},
                                            {VectorTarget::SSE4, "sse4"},
                                            {VectorTarget::SCALAR, "scalar"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CertifiedOptions, frame_coherence, kernel)

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
      .frame_coherent = true,
      .finds_critical_pairs = true,
      .follows_deformation = true,
      .options = with_defaults(
          {{"frame_coherence",
            {{"type", "boolean"},
             {"description", "reuse the last frame's tests; the set is the same either way"}}},
           {"kernel",
            {{"enum",
              {VectorTarget::BEST, VectorTarget::AVX512, VectorTarget::AVX2, VectorTarget::SSE4,
               VectorTarget::SCALAR}},
             {"description",
              "instruction set of the vectorised kernels: the processor's best, or a narrower one for "
              "comparison; the set is the same with each"}}}},
          CertifiedOptions{}),
      .counters = traversal_counters_and<Counter>(
          {{Counter::LEAF_PAIRS, "leaf_pairs", "feature or triangle pairs that reached the leaf tests",
            CountedBy::SEARCH},
           {Counter::DECISIONS, "decisions", "feature pairs that the definition of an LMD was asked for",
            CountedBy::SEARCH},
           {Counter::TRIANGLE_DISTANCES, "triangle_distances",
            "triangle pairs that may touch, decided exactly", CountedBy::SEARCH}}),
      .make = [](const Scene& scene, const nlohmann::json& options) -> std::unique_ptr<Method> {
        return std::make_unique<Certified>(scene, options.get<CertifiedOptions>());
      }};
  return description;
}

}  // namespace lmdbench
