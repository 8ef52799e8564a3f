// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Checks that an STL file is whole before assimp (5.2.5) reads it: that one takes text that is cut
/// short for all of it and 1.5.5 for 1.5, and says of binary files of another length that they hold
/// no triangle. @return the file as assimp reads it: text in lower case, ASCII and without leading
/// blanks
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @throws InputError for text without `endsolid`, vertices that are not three numbers, and binary
///         content of another length than its header announces
std::string checked_stl(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
