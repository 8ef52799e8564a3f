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

/// A page of section 1 in roff's man macros (man-pages(7)), without a date: always the same bits.
/// @param all for the list of commands and for "see also"
std::string man_page(const CommandText& command, const std::vector<CommandText>& all,
                     const std::string& version);

/// Completes commands, options and known values; files elsewhere. Every command also has the
/// program's own options, where they work.
std::string bash_completion(const std::vector<CommandText>& commands);
std::string zsh_completion(const std::vector<CommandText>& commands);

/// Possible values of an option, by its long name: methods from the registry, limits from their
/// table, places in an experiment file (with the "=" before a value) and drivers from its schema.
std::map<std::string, std::vector<std::string>> known_values();

}  // namespace lmdbench::manual
