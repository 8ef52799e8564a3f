// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Checks that an STL file is whole before assimp (5.2.5) reads it: that one takes text that is cut
/// short for all of it, and says of binary files of another length that they hold no triangle.
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @throws InputError for text without `endsolid` and binary content of another length than its
///         header announces
void check_stl(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
