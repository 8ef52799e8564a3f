// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <judge/cell_pairs.h>

#include <cstddef>
#include <vector>

namespace lmdbench::exact {

/// A connected part of { (x, y) : |x - y| <= least + tolerance } that holds a local minimum of the
/// distance. No way leads lower from it without a climb.
struct Basin {
  double least = 0.0;
  /// Least climb of any way to a lower point; infinite where none is within reach.
  double climb = 0.0;
  std::vector<std::size_t> pairs;  ///< Those of CellPairs within the tolerance, ascending.
};

/// The basins that take a climb of at least `least_climb` to leave: components of sublevel sets, by
/// union of pairs of cells in order of distance. A pair of closed cells is a convex set with a
/// convex distance, so two pairs meet below a level exactly where their common cells are that near.
std::vector<Basin> find_basins(const CellPairs& pairs, double tolerance, double least_climb);

/// Pairs connected to `start` through pairs whose distances are in a range.
std::vector<std::size_t> connected_to(const CellPairs& pairs, std::size_t start, double low, double high);

}  // namespace lmdbench::exact
