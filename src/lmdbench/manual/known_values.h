// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lmdbench::manual {

/// What may follow an option, by its long name: methods from the registry, limits from their table, places in an
/// experiment file (with the "=" that a value follows) and drivers from its schema.
std::map<std::string, std::vector<std::string>> known_values();

}  // namespace lmdbench::manual
