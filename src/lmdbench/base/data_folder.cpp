// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/data_folder.h>

#include <system_error>

namespace lmdbench {

std::filesystem::path data_folder_of(const std::filesystem::path& program) {
  const std::filesystem::path share = std::filesystem::path("share") / "lmdbench";
  std::error_code none;
  for (const std::filesystem::path& prefix : {program.parent_path().parent_path(), program.parent_path()})
    if (std::filesystem::is_directory(prefix / share, none)) return prefix / share;
  return {};
}

std::filesystem::path data_folder() {
  std::error_code none;
  return data_folder_of(std::filesystem::read_symlink("/proc/self/exe", none));
}

}  // namespace lmdbench
