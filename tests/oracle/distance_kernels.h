// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>
#include <string>
#include <vector>

namespace lmdbench::testing {

/// A routine that is judged. The whole list is handed over, so that batched kernels fit.
struct DistanceKernel {
  std::string name;
  void (*run)(std::span<const Triangle> a, std::span<const Triangle> b, std::span<double> distances);
};

/// Ours one by one and in vectors, FCL's and CGAL's in double precision.
std::vector<DistanceKernel> distance_kernels();

/// CGAL's squared_distance over doubles, in its own translation unit so that its headers stay there.
void cgal_distances(std::span<const Triangle> a, std::span<const Triangle> b, std::span<double> distances);

}  // namespace lmdbench::testing
