// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/app.h>
#include <lmdbench/cli/commands.h>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <system_error>

namespace {

/// Where a standard descriptor is closed, the next file that opens would take its number, and what
/// is printed. Reading finds the end; writing fails, so that the exit code tells of lost output.
void open_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) == -1) static_cast<void>(open("/dev/null", O_RDONLY));
}

int exit_with(lmdbench::ExitCode code, const std::string& message) {
  spdlog::error("{}", message);
  return static_cast<int>(code);
}

int run_program(int argc, char** argv) {
  using namespace lmdbench;
  int exit_status = static_cast<int>(ExitCode::DONE);
  const std::shared_ptr<CLI::App> app = make_app({argv, argv + argc}, exit_status);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw usage_error(*app, error);
    exit_status = app->exit(error);  // prints help or the version
  }
  // Lost output must not look like success; a command that flushes leaves the error flag.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw EnvironmentError("", "standard output", "cannot be written",
                           "check the disk or the reader of the pipe");
  return exit_status;
}

}  // namespace

int main(int argc, char** argv) {
  using lmdbench::ExitCode;
  open_standard_descriptors();
  lmdbench::set_up_talk(0);
  // At the file size limit (ulimit -f) the write fails, but the program continues.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run_program(argc, argv);
  } catch (const lmdbench::Error& error) {
    return exit_with(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return exit_with(ExitCode::ENVIRONMENT,
                     "out of memory (remedy: a smaller scene, fewer frames or more memory)");
  } catch (const std::system_error& error) {
    // Refusals of the system alone: threads, pipes, writes to standard output.
    return exit_with(
        ExitCode::ENVIRONMENT,
        std::string("the system refuses: ") + error.what() +
            " (remedy: check limits on processes and memory (ulimit -a), disk space, and the reader "
            "of the output)");
  } catch (const std::exception& error) {
    return exit_with(ExitCode::INTERNAL,
                     std::string("bug in lmdbench: ") + error.what() +
                         " (remedy: report it with the command line and its input files)");
  }
}
