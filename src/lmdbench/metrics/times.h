// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/metrics/method_summary.h>

#include <span>
#include <vector>

/// Run time of a method: the one definition of every reported time.
namespace lmdbench {

/// Processor time per haptic frame [s], one row a measured repetition: the local update and the
/// frame's share of the global searches. The paper's global thread is busy between two searches, so
/// a search (with first reduction and second tracking) is spread evenly over the frames to the
/// next; the last one over as many as the one before, if the path ends sooner.
std::vector<std::vector<double>> time_per_frame(const MethodRecord& record);

/// A frame or search counts with the median of its measured repetitions, so that other work of the
/// machine in one of them has no effect; the first repetition is a warm-up, unless it is alone.
/// Statistics are over frames in contact and searches that start in one.
/// @param in_contact  one a frame (contact.h)
void summarise_times(MethodSummary& summary, const MethodRecord& record, const std::vector<bool>& in_contact);

/// Times beyond a run's summary (metrics/times.h): cost of a second, and of an update per LMD.

/// NaN for unmeasured numbers. Medians of measured repetitions, over the frames that count and the
/// searches that start in one.
struct TimeNumbers {
#define NUMBER(name, ...) double name = UNSET;
#include <lmdbench/metrics/time_numbers.def>
#undef NUMBER
};

using TimeNumber = Metric<TimeNumbers>;

/// All numbers, in the order of reports.
std::span<const TimeNumber> time_numbers();

/// @param record its searches' frames, tracked counts and repetitions are read
/// @param counts one a frame
TimeNumbers measure_times(const MethodRecord& record, const std::vector<bool>& counts, double frame_rate_hz);

/// Time of reading the clock twice [s], the median of many: part of every time.
double clock_overhead();

}  // namespace lmdbench
