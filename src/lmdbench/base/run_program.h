// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

struct ProgramOutcome {
  int exit_status = -1;  ///< 128 + signal where a signal ended it
  std::string output;    ///< Standard output and standard error, as they came
};

/// Runs a program without a shell, waits for it and collects its output. Its input is empty.
/// @param argv  the program (looked up in PATH) and its arguments
/// @throws EnvironmentError when it cannot be started, with `remedy`
ProgramOutcome run_program(const std::vector<std::string>& argv, const std::filesystem::path& working_folder,
                           const std::string& remedy);

/// The same with standard output in a new file; `output` of the outcome is standard error alone. A
/// program that writes more than `most_bytes` is ended and the file removed (unpacking bombs).
/// @param file  must not exist
/// @throws EnvironmentError when it cannot be started or the file cannot be written; InputError for
///   too much output, with the program's name as file
ProgramOutcome run_program_to_file(const std::vector<std::string>& argv,
                                   const std::filesystem::path& working_folder, const std::string& remedy,
                                   const std::filesystem::path& file, std::int64_t most_bytes);

/// A new folder that only this user can read, removed with its content at the end of its scope.
class TemporaryFolder {
 public:
  /// @param parent beside a final place, for renaming files, or the system's temporary folder
  /// @param prefix how its name begins
  /// @throws EnvironmentError when it cannot be made
  TemporaryFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lmdbench
