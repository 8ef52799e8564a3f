// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/broken_limits.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

std::vector<std::string> broken_limits(const Acceptance& acceptance, const RunSummary& summary) {
  std::vector<std::string> broken;
  for (const MethodSummary& method : summary.methods) {
    const std::vector<std::string>& judged = acceptance.methods;
    const auto named = [&](const std::string& label) {
      return std::find(judged.begin(), judged.end(), label) != judged.end();
    };
    if (!judged.empty() && !named(method.label) && !named(method.entry)) continue;
    const auto check = [&](const char* what, auto value, auto bound, bool kept, const char* relation) {
      if (kept) return;
      const auto number = static_cast<double>(value);
      const std::string found = std::isnan(number) ? "not measured" : fmt::format("{:.6g}", number);
      broken.push_back(fmt::format("{}: {} is {}, the experiment wants {} {:.6g}", method.label, what, found,
                                   relation, static_cast<double>(bound)));
    };
    const auto wrong = std::ranges::find(summary.nearest_errors, method.label, &NearestError::label);
    if (acceptance.asked && wrong != summary.nearest_errors.end()) broken.push_back(wrong->text());
    // Comparisons with NaN are false: an unmeasured number breaks its limit.
    if (acceptance.recall)
      check("recall", method.recall, *acceptance.recall, method.recall >= *acceptance.recall, "at least");
    if (acceptance.force_error_n)
      check("force error [N]", method.force_error_maximum_n, *acceptance.force_error_n,
            method.force_error_maximum_n <= *acceptance.force_error_n, "at most");
    if (acceptance.late_frames)
      check("number of frames above 1 ms", method.frames_late, *acceptance.late_frames,
            method.frames_late <= static_cast<double>(*acceptance.late_frames), "at most");
    if (acceptance.fcl_disagreements) {
      const auto found = summary.fcl_exceptions.find(method.label);
      const double count = summary.fcl_frames == 0                 ? UNSET
                           : found == summary.fcl_exceptions.end() ? 0.0
                                                                   : static_cast<double>(found->second);
      check("number of disagreements with FCL", count, *acceptance.fcl_disagreements,
            count <= static_cast<double>(*acceptance.fcl_disagreements), "at most");
    }
  }
  return broken;
}

}  // namespace lmdbench
