// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <benchmarks/triangle_distance/implementation.h>

namespace lmdbench::experiments {

/// FCL's kernel, with witness points.
DistanceImplementation fcl_distance() {
  return {"fcl", [](const PairFamily& pairs, std::span<double> distances) {
            for (std::size_t i = 0; i < pairs.size(); ++i)
              distances[i] = fcl_triangle_distance(pairs.a[i], pairs.b[i]).distance;
          }};
}

}  // namespace lmdbench::experiments
