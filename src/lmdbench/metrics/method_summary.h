// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>

#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// A reported number, made from a line of a list (as metrics/method_summary.def).
/// the struct's member, the name in files and in JSON, unit and meaning are made from that line.
template <typename Numbers>
struct Metric {
  std::string_view name;   ///< Of member, dataset and JSON key; ends in its unit.
  std::string_view units;  ///< SI symbol, "1" for counts and ratios.
  double Numbers::*value;
  std::string_view long_name;
  /// Made of times although its unit is not one, so different in every run.
  bool counts_times = false;

  bool made_of_times() const { return units == "s" || counts_times; }
};

/// One method's numbers of a run, NaN for unmeasured ones. They are computed here alone; print,
/// result file and scripts use the same names. Definitions: results/README.md; details: errors.h,
/// times.h.
struct MethodSummary {
  std::string label;
  std::string result_hash;
  std::string entry;    ///< The label without the profile.
  std::string profile;  ///< Of its force profile; empty for a single one.

#define NUMBER(name, ...) double name = UNSET;
#include <lmdbench/metrics/method_summary.def>
#undef NUMBER
};

using SummaryNumber = Metric<MethodSummary>;

/// All numbers, in the order of reports.
std::span<const SummaryNumber> summary_numbers();

}  // namespace lmdbench
