// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/triangle_distance/batch/triangle_distance_batch.h>
#include <benchmarks/triangle_distance/implementation.h>

#include <cmath>
#include <memory>

namespace lmdbench::experiments {

/// The same answers as the scalar kernel, several pairs at a time in the processor's widest vectors.
DistanceImplementation lmdbench_batched_distance() {
  const auto results = std::make_shared<std::vector<TrianglePairDistance>>();
  return {"lmdbench-batched", [results](const PairFamily& pairs, std::span<double> distances) {
            results->resize(pairs.size());
            triangle_distance_batch(pairs.a, pairs.b, *results);
            for (std::size_t i = 0; i < pairs.size(); ++i)
              distances[i] = std::sqrt((*results)[i].squared_distance);
          }};
}

}  // namespace lmdbench::experiments
