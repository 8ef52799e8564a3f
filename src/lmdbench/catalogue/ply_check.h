// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Checks that a PLY file holds what its header announces, before assimp (5.2.5) reads it: that one loops for
/// ever on a header that was cut, and takes a file with fewer faces than announced, or a property of unknown
/// type, for other geometry. Text and both binary forms, in time linear in the file.
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @throws InputError naming the header's line, or the element at which the content ends; also for more faces
///         than the limit of triangles and for polygons with more corners than theirs
void check_ply(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
