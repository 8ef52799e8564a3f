// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/hdf5_handle.h>

#include <filesystem>
#include <string>

namespace lmdbench {

/// Deflate shrinks nothing by more than this factor, so a dataset that claims more than it stores times this is
/// damaged; without the check a few wrong bytes would ask for all memory.
inline constexpr hsize_t LARGEST_DEFLATE_RATIO = 1032;

/// Lets a child process of limited time and memory (`Limit::IMPORT_SECONDS`, `Limit::IMPORT_BYTES`) read a whole
/// HDF5 file, every dataset and attribute, because HDF5 (1.10) crashes, loops or asks for all memory on some
/// damaged files. What it reads to the end there, this process may read, too. Costs as much as reading it once.
/// HDF5 is told to load no filter that a file may name.
/// @throws InputError when there is no such regular file, when the child ends before it has read it, and naming the
///         object for damage that HDF5 reports by itself; what is no HDF5 file at all is left to who opens it
void check_hdf5(const std::filesystem::path& file);

/// What a dataset takes from other files; empty where it is all in its own. Such files are not ours, and what they
/// name may be anything: a device, a FIFO, a file that is nobody's business.
std::string refers_elsewhere(const Hdf5Handle& dataset);

/// Root attribute of a result: SHA-256 of the file's bytes, taken with '0' in place of the attribute's own 64 digits. HDF5 has
/// checksums for chunks alone; this one covers texts, small datasets and the file's structure, too.
inline constexpr const char* CONTENT_HASH = "content_sha256";
/// What the attribute holds until the file is complete; as long as a hash, and like no other text in the file.
inline constexpr const char* CONTENT_HASH_TO_COME =
    "content-sha256:to-come:................................/content-";

/// The image of a result whose attribute still holds CONTENT_HASH_TO_COME, with the hash in its place.
/// @throws std::logic_error when that text is not in the image exactly once
std::string with_content_hash(std::string image);

/// @param hash what the attribute says
/// @throws InputError when the file's bytes have another hash: it was damaged or changed after it was written
void check_content_hash(const std::filesystem::path& file, const std::string& hash);

}  // namespace lmdbench
