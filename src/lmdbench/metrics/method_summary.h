// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>

#include <span>
#include <string>
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

/// One method's numbers of a run, NaN for what was not measured. They are computed once, here, and printed,
/// written into the result file and read by scripts under the same names; results/README.md tells each
/// definition, errors.h and times.h the details.
struct MethodSummary {
  std::string label;
  std::string result_hash;
  std::string entry;    ///< The label without the profile.
  std::string profile;  ///< Name of its force profile; empty for one alone.

#define NUMBER(name, ...) double name = UNSET;
#include <lmdbench/metrics/method_summary.def>
#undef NUMBER
};

using SummaryNumber = Metric<MethodSummary>;

/// All numbers, in the order of reports.
std::span<const SummaryNumber> summary_numbers();

}  // namespace lmdbench
