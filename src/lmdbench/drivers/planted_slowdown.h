// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/two_rate.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>

/// Slowdowns on purpose, to measure how surely `lmdbench compare` finds them: a build with
/// -DLMDBENCH_PLANTED_SLOWDOWN=ON reads "LABEL:STAGE:PERCENT" from LMDBENCH_PLANTED, e.g.
/// "improved:search:5", and works that much longer in every call of that stage. Other builds have
/// none of it, at no cost.
namespace lmdbench {

/// Extra time of each stage of one method, as a share of the time that its work takes.
class PlantedSlowdown {
 public:
#ifdef LMDBENCH_PLANTED_SLOWDOWN
  /// Stages have the names that `lmdbench compare` gives them.
  explicit PlantedSlowdown(const std::string& label) {
    const char* text = std::getenv("LMDBENCH_PLANTED");
    if (text == nullptr || *text == '\0') return;
    const std::string planted(text);
    const std::size_t first = planted.find(':'), last = planted.rfind(':');
    if (first == std::string::npos || first == last)
      throw std::invalid_argument("LMDBENCH_PLANTED is '" + planted + "', not LABEL:STAGE:PERCENT");
    if (planted.substr(0, first) != label) return;
    stage_ = stage_named(planted.substr(first + 1, last - first - 1));
    share_ = std::stod(planted.substr(last + 1)) / 100.0;
  }

  double share(Stage stage) const {
    return stage == stage_ ? share_ : 0.0;
  }

 private:
  static Stage stage_named(const std::string& name) {
    if (name == "search") return Stage::GLOBAL_SEARCH;
    if (name == "reduction") return Stage::FIRST_REDUCTION;
    if (name == "second tracking") return Stage::SECOND_TRACKING;
    if (name == "local update") return Stage::LOCAL_UPDATE;
    throw std::invalid_argument("LMDBENCH_PLANTED names no stage: '" + name + "'");
  }

  Stage stage_ = Stage::LOCAL_UPDATE;
  double share_ = 0.0;
#else
  explicit PlantedSlowdown(const std::string& /*label*/) {}
  static constexpr double share(Stage /*stage*/) {
    return 0.0;
  }
#endif
};

/// Keeps the processor busy for `share` of the time since `begin`.
inline void work_longer(std::chrono::steady_clock::time_point begin, double share) {
  const auto worked = std::chrono::steady_clock::now() - begin;
  const auto end =
      begin + worked + std::chrono::duration_cast<std::chrono::steady_clock::duration>(worked * share);
  while (std::chrono::steady_clock::now() < end) {
  }
}

}  // namespace lmdbench
