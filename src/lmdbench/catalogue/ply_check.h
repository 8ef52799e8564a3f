// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// What stands behind the header of a PLY file.
struct PlyContent {
  std::size_t offset = 0;  ///< In the file.
  bool is_text = true;
};

/// Checks that a PLY file holds what its header announces, before assimp (5.2.5) reads it: that one loops for
/// ever on a header that was cut, and takes a file with fewer faces than announced, or a property of unknown
/// type, for other geometry. Text and both binary forms, in time linear in the file.
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @throws InputError naming the header's line, or the element at which the content ends; also for more faces
///         than the limit of triangles and for polygons with more corners than theirs
PlyContent check_ply(std::string_view bytes, const std::string& file);

/// The PLY file as assimp (5.2.5) reads it right: that one takes a line feed at the begin of binary content for the second half of the
/// header's last line end, where it may be a number's first byte. Such a header gets an end of two bytes (CR LF).
std::string with_its_first_byte(std::string_view ply, const PlyContent& content);

/// Refuses what assimp (5.2.5) reads in more than linear time from OBJ text: lines without end and polygons of
/// more corners than the limit; and what it leaves out or cuts without a word: coordinates that are no numbers (1,5), corners that
/// name no vertex. Linear in the text.
/// @param file  its name, for messages
/// @throws InputError naming the line
void check_obj(std::string_view text, const std::string& file);

/// The text with every line about materials made a comment: they are often lost, mean nothing to a surface, and
/// assimp both complains about them and takes triangles apart by them. Places of all other bytes stay.
std::string without_materials(std::string_view text);

/// The remedy for a mesh file whose length does not fit its header.
inline constexpr const char* CUT_SHORT =
    "the file may be cut short: get it again, or correct the counts in its header";

}  // namespace lmdbench
