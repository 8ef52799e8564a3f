// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <support/committed.h>
#include <support/files.h>
#include <support/scratch_directory.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// Running the built program as a user would.
namespace lmdbench::testing {

/// Exit codes that scripts rely on.
inline constexpr int USAGE = 2;
inline constexpr int INPUT_DATA = 3;
inline constexpr int ENVIRONMENT = 4;

/// An argument for a shell's command, followed by a blank.
inline const std::string SHAPES = "'" + SHAPES_FILE + "' ";

struct Outcome {
  int code = -1;  ///< Exit code, or minus the signal that ended the program.
  std::string out;
  std::string err;
};

/// Runs `lmdbench ARGUMENTS` in a shell; the arguments may redirect and add other commands.
/// @param directory working directory
/// @param processor_seconds a signal ends a process that takes longer; no limit without it
inline Outcome lmdbench(const std::string& arguments,
                        const std::filesystem::path& directory = LMDBENCH_SOURCE_DIR,
                        const std::string& processor_seconds = "unlimited") {
  const ScratchDirectory scratch;
  const std::string out = (scratch / "out").string(), err = (scratch / "err").string();
  const std::string command = "cd '" + directory.string() + "' && ( ulimit -t " + processor_seconds +
                              "; '" LMDBENCH_PROGRAM "' " + arguments + " ) >'" + out + "' 2>'" + err + "'";
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  return outcome;
}

}  // namespace lmdbench::testing
