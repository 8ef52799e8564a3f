// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lmdbench {

/// Whether this build can cross-check (LMDBENCH_WITH_FCL).
bool has_fcl();

/// @param file,place where the cross-check is asked for
/// @throws EnvironmentError in a build without FCL
void require_fcl(const std::string& file, const std::string& place);

}  // namespace lmdbench
