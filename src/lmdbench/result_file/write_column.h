// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/result_file/result_writer.h>

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace lmdbench {

/// One dataset of a table of rows: numbers and flags in one axis, vectors, quaternions in two.
/// @param project gives the number, flag, text, Vec3 or quaternion (x, y, z, w) of a row
template <typename Row, typename Project>
void write_column(ResultWriter& writer, const DatasetInfo& info, const std::vector<Row>& rows,
                  Project project) {
  using Value = std::decay_t<std::invoke_result_t<Project, const Row&>>;
  if constexpr (std::is_same_v<Value, std::string>) {
    std::vector<std::string> values;
    for (const Row& row : rows) values.push_back(project(row));
    writer.write(info, values);
  } else if constexpr (std::is_same_v<Value, Vec3> || std::is_same_v<Value, Eigen::Quaterniond>) {
    std::vector<double> values;
    for (const Row& row : rows) {
      const Value value = project(row);
      if constexpr (std::is_same_v<Value, Vec3>)
        values.insert(values.end(), value.begin(), value.end());
      else
        values.insert(values.end(), value.coeffs().begin(), value.coeffs().end());
    }
    writer.write(info, std::span<const double>(values), {rows.size(), std::is_same_v<Value, Vec3> ? 3U : 4U});
  } else {
    using Stored =
        std::conditional_t<std::is_floating_point_v<Value>, double,
                           std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, std::int64_t>>;
    std::vector<Stored> values;
    values.reserve(rows.size());
    for (const Row& row : rows) values.push_back(static_cast<Stored>(project(row)));
    writer.write(info, std::span<const Stored>(values), {rows.size()});
  }
}

}  // namespace lmdbench
