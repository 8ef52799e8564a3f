// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/sweep/journal.h>
#include <lmdbench/sweep/sweep.h>

#include "promise.h"
#include "targets.h"
#include <support/source_directory.h>

#include <filesystem>
#include <optional>
#include <string>

namespace lmdbench::testing {

std::optional<std::string> broken_sweep(std::string_view bytes) {
  const std::string file = LMDBENCH_SOURCE_DIR "/experiments/sweeps/fuzz.json";
  return broken_unless_refused(file, [&]() -> std::string {
    // Each point reads an experiment, and experiments have a target of their own.
    constexpr std::size_t MOST_POINTS = 3;
    const Sweep read = parse_sweep(std::string(bytes), file, {}, MOST_POINTS);
    if (read.points.empty() || read.points.size() > MOST_POINTS) return "no point, or too many";
    for (const SweepPoint& point : read.points)
      if (point.experiment.methods.size() != 1) return "a point without one method";
    return {};
  });
}

std::optional<std::string> broken_journal(std::string_view bytes) {
  const std::filesystem::path file = written_file(bytes);
  if (!is_own_journal(file)) return std::nullopt;
  return broken_unless_refused(file.string(), [&]() -> std::string {
    const Journal read(file);
    const nlohmann::json* found = read.find("a", 1);
    return found == nullptr || (found->at("key") == "a" && found->at("repetition") == 1) ? ""
                                                                                         : "found another";
  });
}

}  // namespace lmdbench::testing
