// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/hdf5_handle.h>

#include <filesystem>
#include <string>

namespace lmdbench {

/// Deflate shrinks nothing by more than this factor, so a dataset that claims more than its stored
/// bytes times this is damaged. Without the check a few wrong bytes would ask for all memory.
inline constexpr hsize_t LARGEST_DEFLATE_RATIO = 1032;

/// Lets a child process of limited time and memory (`Limit::IMPORT_SECONDS`, `Limit::IMPORT_BYTES`)
/// read a whole HDF5 file, every dataset and attribute: HDF5 (1.10) crashes, loops or asks for all
/// memory on some damaged files. If the child succeeds, this process may read the file. Costs one
/// reading. HDF5 is told to load no filter that a file may name.
/// @throws InputError when there is no such regular file, when the child ends early, and, naming
///         the object, for damage that HDF5 reports; a file that is not HDF5 fails when opened
void check_hdf5(const std::filesystem::path& file);

/// The other file that a dataset takes its values from; empty if none. Such a file could be
/// anything: a device, a FIFO, a private file.
std::string refers_elsewhere(const Hdf5Handle& dataset);

/// Root attribute of a result: SHA-256 of the file's bytes, with '0' for the attribute's own 64
/// digits. HDF5 has checksums of chunks alone; this covers texts, small datasets, structure.
inline constexpr const char* CONTENT_HASH = "content_sha256";
/// Its value until the file is complete: as long as a hash, and like no other text in the file.
inline constexpr const char* CONTENT_HASH_TO_COME =
    "content-sha256:to-come:................................/content-";

/// The image of a result with the hash in place of CONTENT_HASH_TO_COME.
/// @throws std::logic_error when that text is not in the image exactly once
std::string with_content_hash(std::string image);

/// @param hash as the attribute gives it
/// @throws InputError when the file's bytes have another hash: they changed after it was written
void check_content_hash(const std::filesystem::path& file, const std::string& hash);

}  // namespace lmdbench
