// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/difference.h>
#include <lmdbench/result_file/result_reader.h>

#include <string>
#include <vector>

namespace lmdbench {

/// Whether two results come from the same experiment on the same inputs: the resolved experiment as JSON (methods by
/// label; without names, titles, places of files, probes, recording and repetitions, which change no result) and SHA-256 of
/// every input. A key that only one side knows is no difference: versions of the program may differ in their options.
std::vector<Difference> experiment_differences(const ResultReader& base, const ResultReader& candidate);

/// What two programs made of one experiment before any method ran: meshes and force constants of /scene, poses of /path.
std::vector<Difference> scene_differences(const ResultReader& base, const ResultReader& candidate);

}  // namespace lmdbench
