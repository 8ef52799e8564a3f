// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/metrics/method_summary.h>

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

}  // namespace lmdbench
