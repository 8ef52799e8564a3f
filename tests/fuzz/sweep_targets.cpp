// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/sweep/journal.h>
#include <lmdbench/sweep/sweep.h>

#include "promise.h"
#include "targets.h"
#include <support/source_directory.h>

#include <string>

namespace lmdbench::testing {

std::string broken_sweep(std::string_view bytes) {
  const std::string file = LMDBENCH_SOURCE_DIR "/experiments/sweeps/fuzz.json";
  return broken_unless_refused(file, [&]() -> std::string {
    const Sweep read = parse_sweep(std::string(bytes), file);
    if (read.points.empty()) return "no point";
    for (const SweepPoint& point : read.points)
      if (point.experiment.methods.size() != 1) return "a point without one method";
    return {};
  });
}

std::string broken_journal(std::string_view bytes) {
  const MemoryFile file(bytes);
  return broken_unless_refused(file.name().string(), [&]() -> std::string {
    if (!is_own_journal(file.name())) return {};
    const Journal read(file.name());
    return read.find("no such point", 0) == nullptr ? "" : "found what is not there";
  });
}

}  // namespace lmdbench::testing
