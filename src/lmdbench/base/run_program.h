// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

struct ProgramOutcome {
  int exit_status = -1;  ///< 128 + signal where a signal ended it
  std::string output;    ///< Standard output and standard error, as they came
};

/// Runs a program without a shell, waits for it and collects what it says. Its input is empty.
/// @param argv  the program (looked up in PATH) and its arguments
/// @throws EnvironmentError when it cannot be started, with `remedy`
ProgramOutcome run_program(const std::vector<std::string>& argv, const std::filesystem::path& working_folder,
                           const std::string& remedy);

}  // namespace lmdbench
