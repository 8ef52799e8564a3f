// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/build_mesh.h>
#include <lmdbench/catalogue/manifest.h>

#include <filesystem>

namespace lmdbench {

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
