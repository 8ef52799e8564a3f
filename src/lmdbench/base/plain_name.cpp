// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/plain_name.h>

#include <algorithm>
#include <cctype>

namespace lmdbench {

std::string plain_name(std::string_view stem, std::string_view also) {
  constexpr std::string_view ALPHANUMERIC = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  constexpr std::size_t HASH_DIGITS = 6;
  std::string name;
  bool is_ascii = true;
  for (const char c : stem) {
    const bool plain = static_cast<unsigned char>(c) < 128;
    is_ascii = is_ascii && plain;
    if (!plain) continue;
    const bool stays =
        ALPHANUMERIC.find(c) != std::string_view::npos || also.find(c) != std::string_view::npos;
    name += stays ? c : '-';
  }
  name.erase(0, std::min(name.find_first_of(ALPHANUMERIC), name.size()));
  if (!is_ascii) name += (name.empty() ? "" : "-") + sha256_of_text(stem).substr(0, HASH_DIGITS);
  return name;
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return c >= 128 || std::isalnum(c) != 0 ||
           std::string_view("-_./+,:@%=").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace lmdbench
