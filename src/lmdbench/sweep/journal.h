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

/// The finished work of a sweep, beside its result: a JSON line for each point and repetition, on
/// disk before the next begins. A stopped or extended sweep continues from it. (Unlike a run's
/// part, partial_result.h, of fixed shape and too fast for system calls: here points change between
/// runs of the program, and an entry is one measurement, about once a minute.)
namespace lmdbench {

class Journal {
 public:
  /// Reads the file without a change. A line cut short (the process was killed) is dropped, as is
  /// any line of another kind.
  /// @throws EnvironmentError when it is there and cannot be read to its end
  explicit Journal(std::filesystem::path file);

  /// Reads another journal as well, which is never written to. Of two entries for one point and
  /// repetition the first read counts; both count as begun. Files of other kinds are skipped.
  void read_also(const std::filesystem::path& other);

  /// The entry of a point and repetition; null where there is none.
  const nlohmann::json* find(const std::string& key, std::int64_t repetition) const;

  /// Which of the files read has an entry that is there.
  const std::filesystem::path& file_of(const std::string& key, std::int64_t repetition) const;

  /// @param entry has "key" and "repetition"
  /// @throws EnvironmentError when the disk does not take it
  void append(nlohmann::json entry);

  /// Notes that a traversal will begin, so that one that is cut off leaves a trace.
  /// @param where as in the traversal's entry (node_watch.h)
  void begin(const std::string& key, std::int64_t repetition, nlohmann::json where);

  /// Where the traversals of a point and repetition began, in order; several if repeated.
  const std::vector<nlohmann::json>& begun(const std::string& key, std::int64_t repetition) const;

  /// Notes why a point has no numbers. This is no entry: the next run tries the point again.
  void fail(const std::string& key, const std::string& why);

  /// Drops the entries of a point, whose repetitions contradict each other: it is measured anew.
  void discard(const std::string& key);

  /// Reason of the last failure; null where none failed, or a later try succeeded.
  const std::string* failure(const std::string& key) const;

  const std::filesystem::path& file() const { return file_; }

 private:
  using Place = std::pair<std::string, std::int64_t>;
  struct Entry {
    nlohmann::json line;
    std::filesystem::path file;
  };

  /// @return bytes up to the end of the last whole line
  std::uintmax_t read(const std::filesystem::path& file);
  void remember(nlohmann::json line, const std::filesystem::path& file);
  void write(nlohmann::json line);

  std::filesystem::path file_;
  std::uintmax_t whole_ = 0;  ///< Bytes of whole lines: the next line begins there.
  std::map<Place, Entry> entries_;
  std::map<Place, std::vector<nlohmann::json>> begun_;
  std::map<std::string, std::string> failures_;
};

/// Whether a file is a journal of this program.
bool is_own_journal(const std::filesystem::path& file);

}  // namespace lmdbench
