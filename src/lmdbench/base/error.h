// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

/// Errors that end a command. The library throws them and never prints or aborts;
/// `cli/` maps them to exit codes.
namespace lmdbench {

/// Exit codes of the command line (design contract; scripts depend on them).
enum class ExitCode : int {
  DONE = 0,          ///< Everything asked for was done.
  CHECK_FAILED = 1,  ///< A check or a comparison failed.
  USAGE = 2,         ///< Command line or experiment file wrong.
  INPUT_DATA = 3,    ///< Mesh, path or result file wrong.
  ENVIRONMENT = 4,   ///< Something that the environment should offer is missing.
  INTERNAL = 70      ///< A bug of ours.
};

/// Every message names the file, the place in it, the problem and the remedy. Content of hostile
/// files is made `printable`, and long parts are cut so that the remedy is read.
class Error : public std::runtime_error {
 public:
  /// @param code    exit code of the program when nobody handles the error
  /// @param file    file at fault, or empty (command line, environment)
  /// @param place   place in the file: JSON pointer, "line 12", "triangle 7"; may be empty
  /// @param problem what is wrong
  /// @param remedy  what the user can do
  Error(ExitCode code, const std::string& file, const std::string& place, const std::string& problem,
        const std::string& remedy)
      : std::runtime_error(message(file, place, problem, remedy)), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  static std::string message(const std::string& file, const std::string& place, const std::string& problem,
                             const std::string& remedy);

  ExitCode code_;
};

/// Command line or experiment file wrong: exit code 2.
class UsageError : public Error {
 public:
  UsageError(const std::string& file, const std::string& place, const std::string& problem,
             const std::string& remedy)
      : Error(ExitCode::USAGE, file, place, problem, remedy) {}
};

/// Mesh, path or result file wrong: exit code 3.
class InputError : public Error {
 public:
  InputError(const std::string& file, const std::string& place, const std::string& problem,
             const std::string& remedy)
      : Error(ExitCode::INPUT_DATA, file, place, problem, remedy) {}
};

/// A tool, package, permission or disk space is missing: exit code 4.
class EnvironmentError : public Error {
 public:
  EnvironmentError(const std::string& file, const std::string& place, const std::string& problem,
                   const std::string& remedy)
      : Error(ExitCode::ENVIRONMENT, file, place, problem, remedy) {}
};

}  // namespace lmdbench
