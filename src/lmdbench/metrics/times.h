// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/metrics/method_summary.h>

#include <span>
#include <vector>

/// What the run time of a method is: the one definition of every reported time.
namespace lmdbench {

/// Processor time per haptic frame [s], one row a measured repetition: the local update and the frame's share
/// of the global searches. The paper's global thread is busy between two searches, so a search (with its first
/// reduction and second tracking) is spread evenly over the frames up to the next one.
std::vector<std::vector<double>> time_per_frame(const MethodRecord& record);

/// A frame or search counts with the median of its measured repetitions (the first repetition warms up, and
/// counts only if it is alone), so that what else a busy machine does in a single one says nothing. Statistics
/// are over the frames in contact and over the searches that start in one.
/// @param in_contact  one a frame (contact.h)
void summarise_times(MethodSummary& summary, const MethodRecord& record, const std::vector<bool>& in_contact);

/// Times beyond those of a run's summary (metrics/times.h): what all of a second costs, and what an update costs
/// per LMD that it carries.

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
