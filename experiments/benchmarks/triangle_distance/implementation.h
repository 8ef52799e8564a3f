// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// A family of pairs (a[i], b[i]), the same in every run.
struct PairFamily {
  std::string name;
  std::vector<Triangle> a;
  std::vector<Triangle> b;

  std::size_t size() const { return a.size(); }
};

/// Task "triangle distance": the distances of many pairs. Each implementation receives the
/// whole list, so that batched kernels fit.
struct DistanceImplementation {
  std::string name;
  std::function<void(const PairFamily& pairs, std::span<double> distances)> run;
};

/// All implementations of this build.
std::vector<DistanceImplementation> distance_implementations();

/// Triangles with sides of about 1, in general position:
/// - "random": independent, a few sizes apart, so that kernels with early exits take them;
/// - "near": 1 % of the size apart, like the leaf pairs at the end of a search.
std::vector<PairFamily> pair_families(std::size_t count);

}  // namespace lmdbench::experiments
