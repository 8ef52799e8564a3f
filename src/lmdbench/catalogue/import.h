// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/input_file.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <filesystem>

namespace lmdbench {

/// Reads a mesh file: OFF, PLY, OBJ and STL by `parse_off`, `parse_ply`, `parse_obj` and
/// `parse_stl`, glTF 2 through assimp in a child process (`read_with_assimp`).
/// - All meshes of the file are merged, each moved by its node's transform; mirrored ones are
///   turned right side out.
/// - Vertices with bit-identical positions are welded (0 and -0 count as one): formats such as STL
///   give every triangle its own corners, but adjacency, normals and polar cones need the
///   neighbours. Never by a distance: an epsilon would close real gaps, collapse small triangles
///   and depend on the model's scale, and the result would depend on the order of visits.
/// - Triangles and their corners keep the file's order; those without area stay (`check_mesh`
///   counts them). Polygons become triangles in place. Points and lines are no surface and are
///   skipped.
/// - Vertices keep the file's order too. Those without triangles are dropped: they are not on the
///   surface and must not count for its size.
/// - Coordinates stay as they are; no unit is guessed. OFF is read in double precision, PLY in that
///   of its header, all else in single precision.
/// @throws InputError when the file cannot be read, holds no triangle, a coordinate that is not
///   finite or an index out of range; it names the vertex or triangle, counted from 0
TriangleMesh import_mesh(const std::filesystem::path& file);

/// The same from a file's bytes; its extension names the format.
TriangleMesh import_mesh(const FileContent& content);

/// The file's vertices and triangles as they are, neither welded nor dropped, for whoever knows the
/// triangles already. Sizes and limits are not checked.
/// @throws InputError as `import_mesh`
TriangleMesh import_unwelded(const FileContent& content);

/// A mesh file's bytes and their hash.
/// @throws InputError when it cannot be read or is too large
FileContent read_mesh_file(const std::filesystem::path& file);

/// Welds vertices with bit-identical positions and drops those without triangles; keeps the order.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace lmdbench
