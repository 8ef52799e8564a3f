// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/work_counters.h>

#include <string>
#include <vector>

namespace lmdbench {

/// What was wrong with the answers of a method from outside, a clause each, with why the last lost
/// one was lost; empty for other methods.
/// @param label of the method, for the text
/// @param all   counters of all its answers
std::vector<std::string> outsider_notes(const MethodDescription& method, const std::string& label,
                                        const WorkCounters& all);

}  // namespace lmdbench
