// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// Facts about the machine that decide how far timings can be compared: name and value, in a fixed order;
/// "unknown" where the system does not say. Nothing here names the machine or its user.
std::vector<std::pair<std::string, std::string>> machine_info();

}  // namespace lmdbench
