// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/metric.h>
#include <lmdbench/run/records.h>

#include <span>
#include <string>

namespace lmdbench {

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
