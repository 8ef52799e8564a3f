// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/manual/command_line.h>

#include <string>
#include <vector>

namespace lmdbench::manual {

/// Completion of commands, options and known values; files elsewhere. Options of the program itself are offered behind every
/// command, too, where they are understood.
std::string bash_completion(const std::vector<CommandText>& commands);
std::string zsh_completion(const std::vector<CommandText>& commands);

}  // namespace lmdbench::manual
