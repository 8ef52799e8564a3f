// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Place and form of the content after the header of a PLY file.
struct PlyContent {
  std::size_t offset = 0;  ///< In the file.
  bool is_text = true;
};

/// Checks that a PLY file holds what its header announces before assimp (5.2.5) reads it: that one
/// loops for ever on a truncated header, and reads other geometry from a file with fewer faces than
/// announced, a property of unknown type, or text that is no number or does not hold one element a
/// line. Text and both binary forms, linear in the file.
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @throws InputError naming the line or the element at which the content ends; also above the
///   limits of faces and of corners of a polygon, and for vertices without x, y or z
PlyContent check_ply(std::string_view bytes, const std::string& file);

/// The PLY file as assimp (5.2.5) reads it right. assimp takes a line feed at the start of binary
/// content, perhaps a number's first byte, for part of the header's end; such a header gets CR LF.
std::string with_its_first_byte(std::string_view ply, const PlyContent& content);

/// Refuses OBJ text that assimp (5.2.5) reads in more than linear time (endless lines, polygons of
/// more corners than the limit) or silently drops or cuts (coordinates that are not numbers (1,5),
/// corners without a vertex). Linear in the text.
/// @param file  its name, for messages
/// @throws InputError naming the line
void check_obj(std::string_view text, const std::string& file);

/// The text with lines about materials made comments: they are often lost, mean nothing to a
/// surface, and assimp complains and splits triangles by them. Comments behind data, which assimp
/// takes for data, become blanks. All other bytes keep their places.
std::string without_materials(std::string_view text);

/// The remedy for a mesh file that is shorter than its header says.
inline constexpr const char* CUT_SHORT =
    "the file may be cut short: get it again, or correct the counts in its header";

/// The remedy for one that is longer.
inline constexpr const char* TOO_LONG = "correct the counts in its header, or get the file again";

}  // namespace lmdbench
