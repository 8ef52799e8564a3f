// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/run/complete_truth.h>

#include <algorithm>

namespace lmdbench {

std::optional<CompleteTruth> complete_truth(std::vector<ProbedRecord> candidates) {
  // By label, so that another order of methods in the experiment is no other truth.
  std::sort(candidates.begin(), candidates.end(),
            [](const ProbedRecord& a, const ProbedRecord& b) { return a.record->label < b.record->label; });
  for (const auto& [record, probed] : candidates) {
    const bool stands =
        !probed->empty() && std::all_of(probed->begin(), probed->end(),
                                        [](const TruthComparison& row) { return row.same.exact(); });
    if (!stands || record->force_by_law.front().empty()) continue;
    CompleteTruth truth{record->label, record->force_by_law, {}};
    for (const FrameRecord& frame : record->frames) truth.lmd_count.push_back(frame.lmd_count);
    return truth;
  }
  return std::nullopt;
}

}  // namespace lmdbench
