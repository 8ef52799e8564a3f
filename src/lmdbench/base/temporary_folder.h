// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace lmdbench {

/// A new folder that only this program's user can read, removed with all it holds at the end of its scope.
class TemporaryFolder {
 public:
  /// @param parent where it is made: beside a final place, so that files can be renamed, or the system's temporary folder
  /// @param prefix how its name begins
  /// @throws EnvironmentError when it cannot be made
  TemporaryFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lmdbench
