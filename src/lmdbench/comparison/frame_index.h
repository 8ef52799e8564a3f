// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace lmdbench {

/// The haptic frame that a row of a dataset belongs to, by the datasets that say so (results/README.md): `frame` or
/// `frame_offset` of the dataset's own group, `global_frame` of the method for what has one row a search, and the row
/// itself for what has one row a frame.
/// @param group   "/methods/improved", or "/reference"
/// @param dataset path inside the group
/// @return unset where the file does not tell
std::optional<std::int64_t> frame_of_row(const ResultReader& file, const std::string& group,
                                         const std::string& dataset, std::size_t row);

}  // namespace lmdbench
