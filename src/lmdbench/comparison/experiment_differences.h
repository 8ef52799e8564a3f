// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/result_file/result_reader.h>

#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// Whether two results come from the same experiment on the same inputs: the resolved experiment as JSON (methods by
/// label; without names, titles, places of files, probes, recording and repetitions, which change no result) and SHA-256 of
/// every input. A key that only one side knows is no difference: versions of the program may differ in their options.
std::vector<Difference> experiment_differences(const ResultReader& base, const ResultReader& candidate);

/// Whether a difference of experiments is one of their frames (meshes, path, rate, how many) rather than of what is done in
/// them: force, methods, searches, device.
bool is_of_frames(const Difference& difference);

/// What two programs made of one experiment before any method ran: meshes and force constants of /scene, poses of /path.
std::vector<Difference> scene_differences(const ResultReader& base, const ResultReader& candidate);

/// Facts of /provenance/machine, name and value, sorted by name.
std::vector<std::pair<std::string, std::string>> machine_of(const ResultReader& file);

/// Why absolute times of two results cannot be compared: processor, caches, virtual machine, frequency settings that
/// differ. Each reason is a phrase with both values; empty where times can be compared.
std::vector<std::string> machine_differences(const ResultReader& a, const ResultReader& b);

/// What differs in how the two programs were built or what they ran on, without forbidding a comparison: compiler, flags,
/// libraries, kernel.
std::vector<std::string> build_differences(const ResultReader& a, const ResultReader& b);

}  // namespace lmdbench
