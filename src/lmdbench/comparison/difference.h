// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

namespace lmdbench {

/// A place where two results that should be the same are not: the first row of one dataset that differs.
struct Difference {
  std::string method;  ///< Label; empty for what belongs to no method (experiment, inputs, truth)
  std::string
      dataset;  ///< Path inside the method's group, "force" or "counters/node_pairs"; else an absolute path
  std::optional<std::int64_t> frame;  ///< Haptic frame; unset where the whole dataset or attribute differs
  nlohmann::json base;  ///< Value there: number, text or row of numbers; null for NaN and for "absent"
  nlohmann::json candidate;
  std::size_t rows = 0;  ///< Rows of the dataset that differ, this one included; 0 where there are no rows
};

/// The order of reports: what belongs to no method, then by frame, so that the first entry is nearest to the cause;
/// whole datasets last.
inline bool reported_before(const Difference& a, const Difference& b) {
  const auto key = [](const Difference& d) {
    return std::tuple(!d.method.empty(), d.frame.value_or(std::numeric_limits<std::int64_t>::max()), d.method,
                      d.dataset);
  };
  return key(a) < key(b);
}

}  // namespace lmdbench
