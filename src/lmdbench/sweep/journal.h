// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// What a sweep has done so far, beside its result: a JSON line for each point and repetition, on the disk before the
/// next one begins. A sweep that is stopped, or gets another point, goes on from there. (A run's part, partial_result.h,
/// is another thing: its shape is known before the first frame, and a frame has no time for a call of the system. Here
/// points come and go between two sittings, and an entry is what one of them happened to measure, once a minute.)
namespace lmdbench {

class Journal {
 public:
  /// Reads what is there and changes nothing. A line that was cut short (the process was killed) is dropped, as is what is no
  /// line of ours.
  explicit Journal(std::filesystem::path file);

  /// Reads another journal as well, of what was measured elsewhere. Nothing is written to it. Of two entries for one point and
  /// repetition the one read first stands; both count as begun. What is no journal of ours is passed over.
  void read_also(const std::filesystem::path& other);

  /// The entry of a point and repetition; null where there is none.
  const nlohmann::json* find(const std::string& key, std::int64_t repetition) const;

  /// @param entry has "key" and "repetition"
  /// @throws EnvironmentError when it cannot be brought to the disk
  void append(nlohmann::json entry);

  /// Notes that a traversal begins, before it does, so that one that was cut off leaves its trace.
  /// @param where what the traversal's entry will say of it as well (node_watch.h)
  void begin(const std::string& key, std::int64_t repetition, nlohmann::json where);

  /// Where the traversals of a point and repetition began, one after the other; more than one where it was done again.
  const std::vector<nlohmann::json>& begun(const std::string& key, std::int64_t repetition) const;

  /// Notes that a point has no numbers, and why. It is no entry: whoever comes next tries the point again.
  void fail(const std::string& key, const std::string& why);

  /// What the last try left; null where none failed, or one succeeded.
  const std::string* failure(const std::string& key) const;

  const std::filesystem::path& file() const { return file_; }

 private:
  using Place = std::pair<std::string, std::int64_t>;

  /// @return bytes up to the end of the last whole line
  std::uintmax_t read(const std::filesystem::path& file);
  void remember(nlohmann::json line);
  void write(nlohmann::json line);

  std::filesystem::path file_;
  std::uintmax_t whole_ = 0;  ///< Of the file: the next line must not be written behind half a one.
  std::map<Place, nlohmann::json> entries_;
  std::map<Place, std::vector<nlohmann::json>> begun_;
  std::map<std::string, std::string> failures_;
};

/// Whether a file is a journal of this program.
bool is_own_journal(const std::filesystem::path& file);

}  // namespace lmdbench
