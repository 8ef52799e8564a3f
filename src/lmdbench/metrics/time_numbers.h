// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/metric.h>
#include <lmdbench/run/records.h>

#include <span>
#include <vector>

/// Times beyond those of a run's summary (metrics/times.h): what all of a second costs, and what an update costs
/// per LMD that it carries.
namespace lmdbench {

/// NaN for what was not measured. Over the frames that count, and the searches that start in one; a frame or search has
/// the median of its measured repetitions.
struct TimeNumbers {
#define NUMBER(name, ...) double name = UNSET;
#include <lmdbench/metrics/time_numbers.def>
#undef NUMBER
};

using TimeNumber = Metric<TimeNumbers>;

/// All numbers, in the order of reports.
std::span<const TimeNumber> time_numbers();

/// @param record of which the searches' frames, the frames' tracked counts and the repetitions are read
/// @param counts one a frame
TimeNumbers measure_times(const MethodRecord& record, const std::vector<bool>& counts, double frame_rate_hz);

/// What reading the clock twice costs [s], the median of many: part of every time.
double clock_overhead();

}  // namespace lmdbench
