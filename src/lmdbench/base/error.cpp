// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/printable_text.h>

namespace lmdbench {
namespace {

/// Longest part of a message [bytes]: a long path and a list of forty names fit.
constexpr std::size_t LONGEST_PART = 2000;

}  // namespace

std::string Error::message(const std::string& file, const std::string& place, const std::string& problem,
                           const std::string& remedy) {
  const auto part = [](const std::string& text) { return printable(text, LONGEST_PART); };
  return (file.empty() ? "" : part(file) + ": ") + (place.empty() ? "" : part(place) + ": ") + part(problem) +
         (remedy.empty() ? "" : " (remedy: " + part(remedy) + ")");
}

}  // namespace lmdbench
