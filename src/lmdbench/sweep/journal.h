// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

/// What a sweep has done so far, beside its result: a JSON line for each point and repetition, on the disk before the
/// next one begins. A sweep that is stopped, or gets another point, goes on from there. (A run's part, partial_result.h,
/// is another thing: its shape is known before the first frame, and a frame has no time for a call of the system. Here
/// points come and go between two sittings, and an entry is what one of them happened to measure, once a minute.)
namespace lmdbench {

class Journal {
 public:
  /// Reads what is there. A line that was cut short (the process was killed) is dropped, as is what is no line of ours.
  explicit Journal(std::filesystem::path file);

  /// The entry of a point and repetition; null where there is none.
  const nlohmann::json* find(const std::string& key, std::int64_t repetition) const;

  /// @param entry has "key" and "repetition"
  /// @throws EnvironmentError when it cannot be brought to the disk
  void append(nlohmann::json entry);

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::map<std::pair<std::string, std::int64_t>, nlohmann::json> entries_;
};

/// Whether a file is a journal of this program.
bool is_own_journal(const std::filesystem::path& file);

}  // namespace lmdbench
