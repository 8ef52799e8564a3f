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

/// The whole command line of `lmdbench`: it parses, and man pages and completions are made from it.
/// Commands run while it parses.
/// @param argv        of the program, for provenance
/// @param exit_status receives the exit code of a command with a verdict; outlives the result
std::shared_ptr<CLI::App> make_app(const std::vector<std::string>& argv, int& exit_status);

/// The fault of a command line that did not parse: first a command, option or argument that does
/// not exist (with the nearest that does), since a missing one is often misspelt.
/// @param app the one that parsed it
UsageError usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace lmdbench
