// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <judge/basins.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace lmdbench::exact {

std::vector<std::size_t> connected_to(const CellPairs& pairs, std::size_t start, double low, double high) {
  std::set<std::size_t> seen = {start};
  std::vector<std::size_t> open = {start};
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    pairs.for_neighbours(i, [&](std::size_t other) {
      const double distance = pairs[other].distance;
      if (distance >= low && distance <= high && seen.insert(other).second) open.push_back(other);
    });
  }
  return {seen.begin(), seen.end()};
}

std::vector<Basin> find_basins(const CellPairs& pairs, double tolerance, double least_climb) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Of equal distances the larger cells first: a pair comes after those whose boundary it is on.
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::tuple(pairs[i].distance, -pairs.dimension(i), i) <
           std::tuple(pairs[j].distance, -pairs.dimension(j), j);
  });
  constexpr std::size_t NOT_YET = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> parent(pairs.size(), NOT_YET);
  std::vector<std::size_t> lowest(pairs.size());  // of a root: pair where its component was born
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<Basin> basins;
  const auto add = [&](std::size_t birth, double climb) {
    if (!(climb >= least_climb)) return;
    const double least = pairs[birth].distance;
    basins.push_back({least, climb, connected_to(pairs, birth, 0.0, least + tolerance)});
  };
  for (const std::size_t i : order) {
    parent[i] = i;
    lowest[i] = i;
    pairs.for_neighbours(i, [&](std::size_t other) {
      if (parent[other] == NOT_YET) return;
      std::size_t older = root(i), younger = root(other);
      if (older == younger) return;
      if (pairs[lowest[younger]].distance < pairs[lowest[older]].distance) std::swap(older, younger);
      add(lowest[younger], pairs[i].distance - pairs[lowest[younger]].distance);
      parent[younger] = older;
    });
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (parent[i] == i) add(lowest[i], std::numeric_limits<double>::infinity());
  return basins;
}

}  // namespace lmdbench::exact
