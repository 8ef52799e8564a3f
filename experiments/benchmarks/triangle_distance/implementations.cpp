// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/geometry/triangle_distance.h>

#include <benchmarks/triangle_distance/implementation.h>

#include <cmath>

namespace lmdbench::experiments {

std::vector<DistanceImplementation> distance_implementations() {
  return {// The program's exact-form kernel, pair by pair, with witness points and closest features.
          {"lmdbench-scalar",
           [](const PairFamily& pairs, std::span<double> distances) {
             for (std::size_t i = 0; i < pairs.size(); ++i)
               distances[i] = std::sqrt(triangle_distance(pairs.a[i], pairs.b[i]).squared_distance);
           }},
          // FCL's kernel, with witness points.
          {"fcl", [](const PairFamily& pairs, std::span<double> distances) {
             for (std::size_t i = 0; i < pairs.size(); ++i)
               distances[i] = fcl_triangle_distance(pairs.a[i], pairs.b[i]).distance;
           }}};
}

}  // namespace lmdbench::experiments
