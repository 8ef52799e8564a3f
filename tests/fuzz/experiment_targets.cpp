// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/experiment.h>

#include "promise.h"
#include "targets.h"
#include <support/source_directory.h>

#include <optional>
#include <string>

namespace lmdbench::testing {

std::optional<std::string> broken_experiment(std::string_view bytes) {
  const std::string file = LMDBENCH_SOURCE_DIR "/experiments/fuzz.json";
  return broken_unless_refused(file, [&]() -> std::string {
    const Experiment read = parse_experiment(std::string(bytes), file);
    if (read.methods.empty() || read.profiles.empty() || read.objects.size() < 2) return "parts are missing";
    const Experiment again = parse_experiment(read.resolved_json, file);
    return again.resolved_json == read.resolved_json ? "" : "its resolved text resolves to another one";
  });
}

}  // namespace lmdbench::testing
