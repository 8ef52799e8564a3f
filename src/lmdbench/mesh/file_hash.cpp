// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/error.h>
#include <lmdbench/mesh/file_hash.h>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

namespace lmdbench {

std::string sha256_of_file(const std::filesystem::path& file) {
  std::error_code status_error;
  if (std::filesystem::is_directory(file, status_error))
    throw InputError(file.string(), "", "is a directory, not a file", "name a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(file.string(), "", fmt::format("cannot be opened: {}", std::strerror(errno)),
                     "check the name and the permissions");

  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1)
    throw EnvironmentError(file.string(), "", "libcrypto offers no SHA-256", "use an OpenSSL with SHA-256");
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    if (EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(stream.gcount())) != 1)
      throw EnvironmentError(file.string(), "", "libcrypto failed to hash", "check the OpenSSL installation");
  }
  if (stream.bad())
    throw InputError(file.string(), "", "cannot be read to its end", "check the disk and the permissions");

  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int digest_length = 0;
  if (EVP_DigestFinal_ex(context.get(), digest.data(), &digest_length) != 1)
    throw EnvironmentError(file.string(), "", "libcrypto failed to hash", "check the OpenSSL installation");
  std::string text;
  for (unsigned int i = 0; i < digest_length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace lmdbench
