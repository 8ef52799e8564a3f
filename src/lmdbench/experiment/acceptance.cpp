// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/acceptance.h>
#include <lmdbench/experiment/experiment.h>

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
  acceptance.asked = !entry.empty();
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
  if (unprobed != nullptr && experiment.probe_stride("truth") == 0)
    throw UsageError(file, fmt::format("/limits/{}", unprobed), "is not measured: the truth probe is off",
                     "set /probes/truth/stride_frames above 0");
  if (acceptance.fcl_disagreements && experiment.probe_stride("fcl") == 0)
    throw UsageError(file, "/limits/fcl_disagreements", "are not measured: the FCL cross-check is off",
                     "set /probes/fcl/stride_frames above 0");
  return acceptance;
}

}  // namespace lmdbench
