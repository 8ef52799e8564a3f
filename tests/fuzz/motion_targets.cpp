// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/path_spec.h>
#include <lmdbench/motion/tum_file.h>

#include "promise.h"
#include "targets.h"
#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

namespace lmdbench::testing {

std::optional<std::string> broken_tum(std::string_view bytes) {
  return broken_unless_refused("fuzz.tum", [&]() -> std::string {
    const Path path = parse_tum(bytes, "fuzz.tum");
    const Path again = parse_tum(tum_text(path), "fuzz.tum");
    if (again.size() != path.size()) return "poses are lost in writing";
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Eigen::Vector4d& here = path[i].pose.rotation.coeffs();
      if (again[i].time != path[i].time || again[i].pose.translation != path[i].pose.translation ||
          again[i].pose.rotation.coeffs() != here)
        return fmt::format("pose {} does not read back the same", i);
      if (i > 0 && !(path[i].time > path[i - 1].time)) return "time does not increase";
      if (!path[i].pose.translation.allFinite() || !here.allFinite()) return "a pose that is not finite";
    }
    return {};
  });
}

std::optional<std::string> broken_path(std::string_view bytes) {
  return broken_unless_refused("fuzz.json", [&]() -> std::string {
    const PathSpec spec = parse_path_spec(std::string(bytes), "fuzz.json");
    const PathSpec again = parse_path_spec(path_spec_text(spec), "fuzz.json");
    return again.gaps.size() == spec.gaps.size() && again.duration() == spec.duration()
               ? ""
               : "does not read back the same";
  });
}

}  // namespace lmdbench::testing
