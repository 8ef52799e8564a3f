// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/work_of_stage.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lmdbench {

std::string work_of_stage(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                          const std::string& stage) {
  const auto found =
      std::find_if(stages().begin(), stages().end(), [&](const TimedStage& s) { return s.name == stage; });
  if (found == stages().end()) return {};
  const std::string group = "/methods/" + method + "/" + std::string(found->counter_group);
  const std::vector<std::string> counters = base.datasets(group);
  if (counters.empty()) return "its work is not known: the results hold no counters";
  std::string moved;
  bool more = false;
  for (const std::string& counter : counters) {
    const std::string path = group + "/" + counter;
    if (!candidate.has(path)) continue;
    const auto total = [&](const ResultReader& file) {
      const std::vector<std::int64_t> values = file.integers(path);
      return std::accumulate(values.begin(), values.end(), std::int64_t{0});
    };
    const std::int64_t before = total(base), after = total(candidate);
    if (before == after) continue;
    more = more || after > before;
    moved += moved.empty() ? "" : ", ";
    moved += before == 0
                 ? fmt::format("{} from 0 to {}", counter, after)
                 : fmt::format("{} {:+.3g} %", counter,
                               100.0 * static_cast<double>(after - before) / static_cast<double>(before));
  }
  if (moved.empty()) return fmt::format("the same work: none of its {} counters moved", counters.size());
  return (more ? "more work: " : "less work: ") + moved;
}

}  // namespace lmdbench
