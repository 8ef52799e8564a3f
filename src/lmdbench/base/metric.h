// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lmdbench {

/// A number that is reported, with what a reader must know of it. Each is written once, as a line of a list (experiment/method_summary.def):
/// the struct's member, the name in files and in JSON, unit and meaning are made from that line.
template <typename Numbers>
struct Metric {
  std::string_view name;  ///< Of the member, the dataset and the JSON key; ends in its unit where it has one.
  std::string_view units;  ///< SI symbol, "1" for counts and ratios.
  double Numbers::*value;
  std::string_view long_name;
  /// Made of times although its unit is not one: different in every run.
  bool counts_times = false;

  bool made_of_times() const { return units == "s" || counts_times; }
};

}  // namespace lmdbench
