// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/result_file/result_writer.h>

#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Columns of a method's records, their names, units and values: for complete results
/// (`write_result.h`) and parts of runs under way (`run_keeper.h`).
namespace lmdbench {

/// One number, flag or vector of every row.
template <typename Row>
struct Column {
  template <typename Value>
  using Of = std::function<Value(const Row&)>;

  std::string name;  ///< Inside the method's group: "force", "counters/node_pairs".
  std::string units;
  std::string long_name;
  std::variant<Of<double>, Of<std::int64_t>, Of<bool>, Of<Vec3>> value;
};

/// @param value  gives a double, std::int64_t, bool or Vec3 of a row
template <typename Row, typename Value>
Column<Row> column(std::string name, std::string units, std::string long_name, Value value) {
  using Type = std::decay_t<std::invoke_result_t<Value, const Row&>>;
  return {std::move(name), std::move(units), std::move(long_name),
          std::function<Type(const Row&)>(std::move(value))};
}

/// A method of the experiment; with instances also the counters of a world.
MethodDescription described(const Experiment& experiment, const std::string& name);

/// @param torque   whether to have the torque before clipping
/// @param indices  whether LMDs without an index are counted
std::vector<Column<FrameRecord>> frame_columns(const MethodDescription& method, bool torque, bool indices);
/// Empty for a method without searches at a rate of their own.
std::vector<Column<SearchRecord>> search_columns(const MethodDescription& method);
/// Whether a column of those two is a work counter.
bool is_counter(const std::string& name);
/// Of a closed loop.
/// @param turns  whether the device actuates six degrees of freedom
std::vector<Column<LoopFrame>> loop_columns(bool turns);

/// The time in which bodies that deform follow, by repetition and frame.
/// @param group of the method, ends in a slash
DatasetInfo following_time_info(const std::string& group);

/// A time of searches, by repetition and search.
struct SearchTime {
  std::string name;
  std::string long_name;
  std::vector<double> RepetitionTimes::*times;
};
/// Those that the method has.
std::vector<SearchTime> search_times(const MethodDescription& method);

}  // namespace lmdbench
