// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace lmdbench {

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
