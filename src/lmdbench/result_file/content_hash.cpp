// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/result_file/content_hash.h>

#include <stdexcept>
#include <string_view>
#include <utility>

namespace lmdbench {
namespace {

/// Where the digits stand; npos unless they stand there once.
std::size_t only_place_of(std::string_view digits, std::string_view bytes) {
  const std::size_t place = bytes.find(digits);
  if (place == std::string_view::npos || bytes.find(digits, place + 1) != std::string_view::npos)
    return std::string_view::npos;
  return place;
}

std::string hash_without_digits(std::string bytes, std::size_t place, std::size_t length) {
  bytes.replace(place, length, length, '0');
  return sha256_of_text(bytes);
}

}  // namespace

std::string with_content_hash(std::string image) {
  const std::string_view digits = CONTENT_HASH_TO_COME;
  const std::size_t place = only_place_of(digits, image);
  if (place == std::string::npos) throw std::logic_error("a result has no place for the hash of its content");
  const std::string hash = hash_without_digits(image, place, digits.size());
  return image.replace(place, digits.size(), hash);
}

void check_content_hash(const std::filesystem::path& file, const std::string& hash) {
  std::string bytes = read_input_file(file, {.what = "result file"}).bytes;
  const std::size_t place = hash.empty() ? std::string::npos : only_place_of(hash, bytes);
  if (place != std::string::npos && hash_without_digits(std::move(bytes), place, hash.size()) == hash) return;
  throw InputError(file.string(), std::string("attribute ") + CONTENT_HASH,
                   "its bytes are not those that were written: damaged, or changed afterwards",
                   "make the file again with lmdbench run; who changed it on purpose deletes the attribute");
}

}  // namespace lmdbench
