// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/manual/command_line.h>

#include <map>
#include <string>
#include <vector>

namespace lmdbench::manual {

/// "lmdbench.1", "lmdbench-mesh-info.1"
std::string man_page_name(const CommandText& command);

/// A page of section 1 in the man macros of roff (man-pages(7)). Without a date: the same bits in every build.
/// @param all for the list of commands and for "see also"
std::string man_page(const CommandText& command, const std::vector<CommandText>& all,
                     const std::string& version);

/// Completion of commands, options and known values; files elsewhere. Options of the program itself are offered behind every
/// command, too, where they are understood.
std::string bash_completion(const std::vector<CommandText>& commands);
std::string zsh_completion(const std::vector<CommandText>& commands);

/// What may follow an option, by its long name: methods from the registry, limits from their table, places in an
/// experiment file (with the "=" that a value follows) and drivers from its schema.
std::map<std::string, std::vector<std::string>> known_values();

}  // namespace lmdbench::manual
