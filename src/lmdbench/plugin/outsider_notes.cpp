// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/plugin/outsider_notes.h>

#include <fmt/format.h>

namespace lmdbench {

std::vector<std::string> outsider_notes(const MethodDescription& method, const std::string& label,
                                        const WorkCounters& all) {
  std::vector<std::string> notes;
  if (method.plugin.empty()) return notes;
  for (const CounterDescription& mark : method.counters) {
    const std::uint64_t count = all.values[mark.index];
    if (mark.index >= MethodDescription::MARKS || count == 0) continue;
    notes.push_back(fmt::format("{}, from outside: {} {}{}", label, count, mark.summary,
                                mark.index == 0 ? "; the last one: " + method.faults->last() : ""));
  }
  return notes;
}

}  // namespace lmdbench
