// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace lmdbench {

/// The whole command line of `lmdbench`: what the program parses, and what its man pages and completions are made from.
/// Commands run while it parses.
/// @param argv        of the program, for provenance
/// @param exit_status receives the exit code of a command that judges; outlives the result
std::shared_ptr<CLI::App> make_app(const std::vector<std::string>& argv, int& exit_status);

/// What is wrong with a command line that did not parse: a command, option or argument that does not exist first (with the
/// nearest that does), because what CLI11 misses is often what was misspelt.
/// @param app that was asked to parse it
UsageError usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace lmdbench
