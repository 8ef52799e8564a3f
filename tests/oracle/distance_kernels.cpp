// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/distance_kernels.h"

#include <lmdbench/crosscheck/fcl_triangle_distance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_distance_batch.h>

#include <cmath>

namespace lmdbench::testing {
namespace {

void scalar_distances(std::span<const Triangle> a, std::span<const Triangle> b, std::span<double> distances) {
  for (std::size_t i = 0; i < distances.size(); ++i) {
    distances[i] = std::sqrt(triangle_distance(a[i], b[i]).squared_distance);
  }
}

void batch_distances(std::span<const Triangle> a, std::span<const Triangle> b, std::span<double> distances) {
  thread_local std::vector<TrianglePairDistance> results;
  results.resize(distances.size());
  triangle_distance_batch(a, b, results);
  for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = std::sqrt(results[i].squared_distance);
}

void fcl_distances(std::span<const Triangle> a, std::span<const Triangle> b, std::span<double> distances) {
  for (std::size_t i = 0; i < distances.size(); ++i)
    distances[i] = fcl_triangle_distance(a[i], b[i]).distance;
}

}  // namespace

std::vector<DistanceKernel> distance_kernels() {
  return {{"lmdbench", scalar_distances},
          {"lmdbench batch", batch_distances},
          {"FCL", fcl_distances},
          {"CGAL double", cgal_distances}};
}

}  // namespace lmdbench::testing
