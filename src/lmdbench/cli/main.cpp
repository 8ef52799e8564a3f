// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/mesh_command.h>
#include <lmdbench/cli/path_command.h>
#include <lmdbench/cli/talk.h>
#include <lmdbench/record/provenance.h>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace {

int exit_with(lmdbench::ExitCode code, const std::string& message) {
  spdlog::error("{}", message);
  return static_cast<int>(code);
}

int run_program(int argc, char** argv) {
  using namespace lmdbench;
  CLI::App app("Bench for multi-contact haptic rendering with local minimum distances", "lmdbench");
  app.require_subcommand(1);
  app.fallthrough();  // -v and -q work behind the subcommand, too
  app.set_version_flag("--version", version_text());
  int verbose = 0;
  int quiet = 0;
  app.add_flag("-v,--verbose", verbose, "tell more on standard error");
  app.add_flag("-q,--quiet", quiet, "tell errors only");
  app.parse_complete_callback([&] { set_up_talk(verbose - quiet); });
  app.footer(
      "Exit codes: 0 done; 1 a check failed; 2 usage or experiment file wrong; 3 input data wrong; "
      "4 the environment lacks something; 70 a bug of lmdbench.");
  add_run_command(app, {argv, argv + argc});
  add_plan_command(app);
  add_query_command(app);
  add_mesh_command(app);
  add_path_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);  // prints help or what is wrong
    return code == 0 ? 0 : static_cast<int>(ExitCode::USAGE);
  }
  if (std::fflush(stdout) != 0)  // results that did not arrive must not look like success
    throw EnvironmentError("", "standard output", "cannot be written",
                           "check the disk or the reader of the pipe");
  return static_cast<int>(ExitCode::DONE);
}

}  // namespace

int main(int argc, char** argv) {
  using lmdbench::ExitCode;
  lmdbench::set_up_talk(0);
  try {
    return run_program(argc, argv);
  } catch (const lmdbench::Error& error) {
    return exit_with(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return exit_with(ExitCode::ENVIRONMENT,
                     "out of memory (remedy: a smaller scene, fewer frames or more memory)");
  } catch (const std::exception& error) {
    return exit_with(ExitCode::INTERNAL,
                     std::string("bug in lmdbench: ") + error.what() +
                         " (remedy: report it with the command line and its input files)");
  }
}
