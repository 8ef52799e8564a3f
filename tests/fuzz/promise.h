// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// Checks that several formats share.
namespace lmdbench::testing {

/// Runs a reader and a check of its value.
/// @param file  the name that refusals must begin with
/// @param read  returns what is broken, or nothing; throws where it refuses the bytes
/// @return nothing where the reader refused the bytes, empty where they are good, or what is broken
std::optional<std::string> broken_unless_refused(const std::string& file,
                                                 const std::function<std::string()>& read);

/// Empty, or what is wrong: an index out of range, a coordinate that is not finite.
std::string broken_mesh(const TriangleMesh& mesh);

/// Whether two meshes have the same bits.
bool same_mesh(const TriangleMesh& a, const TriangleMesh& b);

/// Writes the bytes to a regular file, which the next call replaces. A descriptor's name under
/// /proc is a link: some readers refuse it, and HDF5 opens only files of a file system.
std::filesystem::path written_file(std::string_view bytes);

}  // namespace lmdbench::testing
