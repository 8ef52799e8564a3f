// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lmdbench {

/// Whether a file is a result of this program, of any format version: HDF5 with the root attribute
/// `format` of results. False for a file that cannot be opened.
bool is_own_result(const std::filesystem::path& file);

}  // namespace lmdbench
