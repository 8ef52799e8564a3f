// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lmdbench::testing {

/// A routine's answer for a pair.
struct DistanceAnswer {
  double distance = 0.0;
  bool touches = false;  ///< Its own flag where it has one, else whether the distance is 0.
  /// Its nearest points, where it promises them in every case. FCL's are arbitrary in contact, CGAL
  /// gives none.
  std::optional<Segment> points;
};

/// A judged routine. It receives the whole list, so that batched kernels fit.
struct DistanceKernel {
  std::string name;
  void (*run)(std::span<const Triangle> a, std::span<const Triangle> b, std::span<DistanceAnswer> answers);
};

/// Ours one by one and in vectors, FCL's and CGAL's in double precision.
std::vector<DistanceKernel> distance_kernels();

/// CGAL's squared_distance over doubles, in a translation unit that alone includes its headers.
void cgal_distances(std::span<const Triangle> a, std::span<const Triangle> b,
                    std::span<DistanceAnswer> answers);

}  // namespace lmdbench::testing
