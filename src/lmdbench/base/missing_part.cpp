// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/missing_part.h>

#include <fmt/format.h>

namespace lmdbench {

EnvironmentError missing_part(const OptionalPart& part, const std::string& file, const std::string& place,
                              const std::string& what) {
  return {
      file, place, fmt::format("{} needs {}, which this build was made without", what, part.name),
      fmt::format("apt-get install {}, then configure with -D{}=ON and build", part.package, part.option)};
}

}  // namespace lmdbench
