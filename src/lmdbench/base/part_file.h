// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/file_descriptor.h>

#include <filesystem>
#include <string_view>

namespace lmdbench {

/// Where a run writes beside its final name, as `<name>.part`, until it is complete. Holds an advisory lock on
/// the part, so that two runs with the same output do not write into each other. The part is new or what an
/// earlier run left: never a link, never a foreign file.
class PartFile {
 public:
  /// Makes missing parent directories, and an empty part where none is; what an earlier run left stays in it.
  /// @throws EnvironmentError when the name is a directory, when a directory or file cannot be made, when
  ///         another process is writing the same result, or when the part is no file of ours
  explicit PartFile(std::filesystem::path final_name);
  ~PartFile() = default;  ///< Releases the lock; the part stays unless `remove` or `publish` took it away.
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& final_name() const { return final_name_; }
  const std::filesystem::path& part_name() const { return part_name_; }
  int descriptor() const { return descriptor_.get(); }

  bool is_empty() const;

  /// Gives the part this content in one step, on the disk.
  /// @throws EnvironmentError, for example when the disk is full; the part is then as before
  void write(std::string_view content);

  /// Takes the part away, once; it must not be written any more.
  void remove();
  bool is_removed() const { return removed_; }

  /// Writes the final file in one step (`write_file_atomically`), then takes the part away. May be tried again
  /// when it failed.
  /// @throws EnvironmentError; the earlier file of the final name and the part are then untouched
  void publish(std::string_view content);

 private:
  void open_and_lock();

  std::filesystem::path final_name_;
  std::filesystem::path part_name_;
  FileDescriptor descriptor_;
  bool removed_ = false;
};

}  // namespace lmdbench
