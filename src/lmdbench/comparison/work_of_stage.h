// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/stage_times.h>
#include <lmdbench/result_file/result_reader.h>

#include <string>

namespace lmdbench {

/// Tells whether a stage does other work or the same work at another speed, by the sums of its counters: "more work:
/// node_pairs +12.5 %, leaf_pairs +3 %", or "the same work: none of its 14 counters moved". The stages of the global
/// thread share their counters.
/// @param stage name of a stage of `stages()`
std::string work_of_stage(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                          const std::string& stage);

}  // namespace lmdbench
