// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/manual/command_line.h>

#include <string>
#include <vector>

namespace lmdbench::manual {

/// "lmdbench.1", "lmdbench-mesh-info.1"
std::string man_page_name(const CommandText& command);

/// A page of section 1 in the man macros of roff (man-pages(7)). Without a date: the same bits in every build.
/// @param all for the list of commands and for "see also"
std::string man_page(const CommandText& command, const std::vector<CommandText>& all,
                     const std::string& version);

}  // namespace lmdbench::manual
