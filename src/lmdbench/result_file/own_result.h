// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lmdbench {

/// Whether a file is a result of this program, of any format version: HDF5 whose root attribute `format` says
/// so. False for what cannot be opened.
bool is_own_result(const std::filesystem::path& file);

}  // namespace lmdbench
