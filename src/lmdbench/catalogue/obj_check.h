// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Refuses what assimp (5.2.5) reads in more than linear time from OBJ text: lines without end and polygons of
/// more corners than the limit. Linear in the text.
/// @param file  its name, for messages
/// @throws InputError naming the line
void check_obj(std::string_view text, const std::string& file);

/// The text with every line about materials made a comment: they are often lost, mean nothing to a surface, and
/// assimp both complains about them and takes triangles apart by them. Places of all other bytes stay.
std::string without_materials(std::string_view text);

}  // namespace lmdbench
