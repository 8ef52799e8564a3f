// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/result_file/result_reader.h>

#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// Differences of two results' experiments: the resolved experiment as JSON (methods by label,
/// scenes in one form; no names, titles, places of files, probes, recording, limits, repetitions,
/// which change no result) and SHA-256 of every input. A key of one side alone is a difference only
/// if it has no default: versions have other options.
std::vector<Difference> experiment_differences(const ResultReader& base, const ResultReader& candidate);

/// What one of the two was asked to probe or to record otherwise: names are JSON pointers.
std::vector<Difference> kept_differences(const ResultReader& base, const ResultReader& candidate);

/// Whether a difference of experiments concerns their frames (meshes, path, rate, number), not the
/// work in them: force, methods, searches, device.
bool is_of_frames(const Difference& difference);

/// Differences made before any method ran: meshes, instances and force constants of /scene, poses
/// of /path.
std::vector<Difference> scene_differences(const ResultReader& base, const ResultReader& candidate);

/// Facts of /provenance/machine, name and value, sorted by name.
std::vector<std::pair<std::string, std::string>> machine_of(const ResultReader& file);

/// Why absolute times of two results cannot be compared: processor, caches, virtual machine,
/// frequency settings. Phrases with both values; empty where times can be compared.
std::vector<std::string> machine_differences(const ResultReader& a, const ResultReader& b);

/// Differences of the two builds and systems that allow a comparison: compiler, flags, libraries,
/// kernel.
std::vector<std::string> build_differences(const ResultReader& a, const ResultReader& b);

}  // namespace lmdbench
