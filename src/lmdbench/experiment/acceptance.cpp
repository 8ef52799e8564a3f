// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/acceptance.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/summary.h>

#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {
namespace {

template <typename Value>
std::optional<Value> limit(const nlohmann::json& entry, const char* key) {
  return entry.contains(key) ? std::optional<Value>(entry[key].get<Value>()) : std::nullopt;
}

}  // namespace

Acceptance read_acceptance(const nlohmann::json& entry, const Experiment& experiment,
                           const std::string& file) {
  Acceptance acceptance;
  for (const nlohmann::json& label : entry.value("methods", nlohmann::json::array()))
    acceptance.methods.push_back(label.get<std::string>());
  acceptance.recall = limit<double>(entry, "recall");
  acceptance.force_error_n = limit<double>(entry, "force_error_n");
  acceptance.fcl_disagreements = limit<std::int64_t>(entry, "fcl_disagreements");
  acceptance.late_frames = limit<std::int64_t>(entry, "late_frames");
  for (std::size_t i = 0; i < acceptance.methods.size(); ++i)
    if (std::none_of(experiment.methods.begin(), experiment.methods.end(), [&](const MethodChoice& method) {
          return method.label == acceptance.methods[i] || method.entry == acceptance.methods[i];
        }))
      throw UsageError(file, fmt::format("/limits/methods/{}", i),
                       fmt::format("no method is called \"{}\"", acceptance.methods[i]),
                       "name labels of this experiment's methods");
  const char* const unprobed = acceptance.recall          ? "recall"
                               : acceptance.force_error_n ? "force_error_n"
                                                          : nullptr;
  if (unprobed != nullptr && experiment.truth_stride_frames == 0)
    throw UsageError(file, fmt::format("/limits/{}", unprobed), "is not measured: the truth probe is off",
                     "set /probes/truth/stride_frames above 0");
  if (acceptance.fcl_disagreements && experiment.fcl_stride_frames == 0)
    throw UsageError(file, "/limits/fcl_disagreements", "are not measured: the FCL cross-check is off",
                     "set /probes/fcl/stride_frames above 0");
  return acceptance;
}

std::vector<std::string> broken_limits(const Acceptance& acceptance, const RunSummary& summary) {
  std::vector<std::string> broken;
  for (const MethodSummary& method : summary.methods) {
    const std::vector<std::string>& judged = acceptance.methods;
    const auto named = [&](const std::string& label) {
      return std::find(judged.begin(), judged.end(), label) != judged.end();
    };
    if (!judged.empty() && !named(method.label) && !named(method.entry)) continue;
    const auto check = [&](const char* what, auto value, auto bound, bool kept, const char* relation) {
      if (!kept)
        broken.push_back(fmt::format("{}: {} is {:.6g}, the experiment wants {} {:.6g}", method.label, what,
                                     static_cast<double>(value), relation, static_cast<double>(bound)));
    };
    // Comparisons with NaN are false: what was not measured is not kept.
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
      const std::int64_t count = found == summary.fcl_exceptions.end() ? 0 : found->second;
      check("number of disagreements with FCL", count, *acceptance.fcl_disagreements,
            count <= *acceptance.fcl_disagreements, "at most");
    }
  }
  return broken;
}

}  // namespace lmdbench
