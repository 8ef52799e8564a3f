// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/force/aggregation.h>

#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {

const std::vector<Aggregation>& aggregations() {
  static const std::vector<Aggregation> all{sum_law(), signed_law(), shared_law(), layered_law()};
  return all;
}

std::vector<std::string> aggregation_names() {
  std::vector<std::string> names;
  for (const Aggregation& law : aggregations()) names.emplace_back(law.name);
  return names;
}

const Aggregation& aggregation_named(std::string_view name, const std::string& file,
                                     const std::string& place) {
  const auto found = std::ranges::find(aggregations(), name, &Aggregation::name);
  if (found != aggregations().end()) return *found;
  throw UsageError(file, place, fmt::format("unknown aggregation \"{}\"", name),
                   fmt::format("known ones: {}", fmt::join(aggregation_names(), ", ")));
}

}  // namespace lmdbench
