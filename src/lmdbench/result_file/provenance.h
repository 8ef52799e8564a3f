// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_writer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// An input of a run, identified by content.
struct InputFile {
  std::string role;  ///< "mesh:bunny-16k", "path"
  std::filesystem::path file;
  std::string sha256;     ///< SHA-256 of the bytes used, hexadecimal (lower case).
  std::int64_t size = 0;  ///< Of these bytes.
};

inline constexpr const char* RESULT_FORMAT = "lmdbench-result";
/// Major version: readers refuse an unknown one. Rises when a dataset changes meaning or ends.
inline constexpr int RESULT_FORMAT_VERSION = 2;
/// Oldest version that is read; it lacks later additions (results/README.md, "Versions").
inline constexpr int OLDEST_RESULT_FORMAT_VERSION = 1;

/// Writes root attributes (`format`, `format_version`, `creator`, `created_utc`) and the group
/// /provenance of the result contract: program version, git commit, dirty flag, compiler and flags,
/// processor, cores, library versions, argv, the resolved experiment and the plan as JSON text, and
/// the inputs with their SHA-256.
/// @param machine  machine_info() before the run, for the load average of that moment
void write_provenance(ResultWriter& writer, const std::vector<std::string>& argv,
                      const std::string& experiment_json, const std::string& plan_json,
                      const std::vector<InputFile>& inputs,
                      const std::vector<std::pair<std::string, std::string>>& machine);

/// Facts about the machine that decide how far timings can be compared: name and value, in a fixed
/// order; "unknown" where the system gives none. Nothing here names the machine or its user.
std::vector<std::pair<std::string, std::string>> machine_info();

/// SHA-256 of the running program, hexadecimal; of the interpreter in the Python module.
std::string program_sha256();

}  // namespace lmdbench
