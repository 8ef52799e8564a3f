// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lmdbench {

/// The whole command line of `lmdbench`: what the program parses, and what its man pages and completions are made from.
/// Commands run while it parses.
/// @param argv        of the program, for provenance
/// @param exit_status receives the exit code of a command that judges; outlives the result
std::shared_ptr<CLI::App> make_app(const std::vector<std::string>& argv, int& exit_status);

}  // namespace lmdbench
