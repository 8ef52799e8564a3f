// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/manifest.h>

#include <filesystem>
#include <functional>
#include <string>

namespace lmdbench {

/// Receives a sentence about slow work.
using Tell = std::function<void(const std::string&)>;

struct BuildOutcome {
  std::string name;
  std::filesystem::path file;
  bool up_to_date = false;  ///< It was there already and matched; nothing was done.
  std::int64_t triangles = 0;
  std::string sha256;
  bool matches_manifest = false;  ///< Triangle count and, where the manifest has one, SHA-256.
};

/// Makes an entry's mesh: fetches and checks its source (or makes the shape), decimates, and writes
/// the built file (`built_mesh_folder`) in one step. Does nothing where it is there and matches the
/// manifest.
/// Another version of meshoptimizer or another processor family may decimate differently. Such a
/// mesh is written too, with `matches_manifest` false: it is as good, but results on it do not
/// compare frame by frame with those on the recorded one.
/// @throws InputError for a wrong SHA-256 of a source, EnvironmentError when it cannot be fetched
BuildOutcome build_mesh(const Manifest& manifest, const ManifestEntry& entry, const Tell& tell);

/// File of a source, checked against its SHA-256. Searches in this order and keeps the file:
/// 1. <folder>/<file name of source.path, without .gz>
/// 2. a package file <folder>/<package>_*.deb or <folder>/<package>-<version>.tgz (for no network)
/// 3. the package from `apt-get download` or `npm pack`; nothing is installed
/// @throws EnvironmentError when apt-get and dpkg, npm, tar or gzip is missing, or the package is
///   not available or lacks the file; InputError when the SHA-256 differs
std::filesystem::path fetch_source(const MeshSource& source, const std::filesystem::path& folder,
                                   const Tell& tell);

}  // namespace lmdbench
