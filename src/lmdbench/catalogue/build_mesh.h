// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/manifest.h>

#include <filesystem>
#include <functional>
#include <string>

namespace lmdbench {

/// Receives a sentence on what takes a while.
using Tell = std::function<void(const std::string&)>;

struct BuildOutcome {
  std::string name;
  std::filesystem::path file;
  bool up_to_date = false;  ///< It was there already and matched; nothing was done.
  std::int64_t triangles = 0;
  std::string sha256;
  bool matches_manifest = false;  ///< Triangle count and, where the manifest has one, SHA-256.
};

/// Realises an entry: fetches and checks its source (or makes the shape), decimates, and writes the built
/// file (`built_mesh_folder`) at once. Does nothing where it is there and matches the manifest.
///
/// A result that differs from the manifest is written all the same and told by `matches_manifest`: another
/// version of meshoptimizer or another processor family may decimate differently, and such a mesh is as good,
/// but results on it do not compare frame by frame with results on the recorded one.
/// @throws InputError when a source's SHA-256 is not the manifest's, EnvironmentError when it cannot be had
BuildOutcome build_mesh(const Manifest& manifest, const ManifestEntry& entry, const Tell& tell);

/// File of a source, checked against its SHA-256. Looks for it in this order and keeps what it finds:
/// 1. <folder>/<file name of source.path, without .gz>
/// 2. in a package file <folder>/<package>_*.deb or <folder>/<package>-<version>.tgz (put one there to work
///    without a network)
/// 3. in the package as `apt-get download` or `npm pack` gets it; nothing is installed
/// @throws EnvironmentError when apt-get and dpkg, or npm, or tar or gzip is missing or the package cannot be
///         had or lacks the file, InputError when the SHA-256 differs
std::filesystem::path fetch_source(const MeshSource& source, const std::filesystem::path& folder,
                                   const Tell& tell);

}  // namespace lmdbench
