// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/geometry/triangle_distance.h>

#include <judge/distance_kernels.h>

#include <cmath>

namespace lmdbench::testing {
namespace {

DistanceAnswer answer(const TrianglePairDistance& result) {
  return {std::sqrt(result.squared_distance), result.intersecting, Segment{result.point_a, result.point_b}};
}

void scalar_distances(std::span<const Triangle> a, std::span<const Triangle> b,
                      std::span<DistanceAnswer> answers) {
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = answer(triangle_distance(a[i], b[i]));
}

void fcl_distances(std::span<const Triangle> a, std::span<const Triangle> b,
                   std::span<DistanceAnswer> answers) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double distance = fcl_triangle_distance(a[i], b[i]).distance;
    answers[i] = {distance, distance == 0.0, std::nullopt};
  }
}

}  // namespace

std::vector<DistanceKernel> distance_kernels() {
  return {{"lmdbench", scalar_distances}, {"FCL", fcl_distances}, {"CGAL double", cgal_distances}};
}

}  // namespace lmdbench::testing
