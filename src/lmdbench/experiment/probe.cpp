// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/experiment.h>

#include <algorithm>

namespace lmdbench {

using Json = nlohmann::json;

void add_probe_schemas(Json& schema) {
  for (const Probe& probe : probes()) {
    Json properties = probe.options;
    properties["stride_frames"] = {{"type", "integer"},
                                   {"minimum", 0},
                                   {"maximum", 1000000},
                                   {"default", probe.stride_frames},
                                   {"description", probe.stride_text}};
    Json& parent = schema["properties"][probe.parent.substr(1)];
    parent["additionalProperties"] = false;
    parent["properties"][probe.name] = {{"type", "object"},
                                        {"additionalProperties", false},
                                        {"default", Json::object()},
                                        {"properties", std::move(properties)}};
  }
}

void read_probes(Experiment& experiment, const Json& document) {
  for (const Probe& probe : probes()) {
    const Json::json_pointer place(probe.parent + "/" + probe.name);
    ProbeChoice& choice = experiment.probes[probe.name];
    choice.options = document[place];
    choice.stride_frames = choice.options["stride_frames"].get<std::int64_t>();
    if (choice.stride_frames > 0 && probe.refuse != nullptr)
      probe.refuse(experiment, experiment.file.string(), (place / "stride_frames").to_string());
  }
}

std::vector<std::int64_t> probed_frames(std::int64_t frame_count, std::int64_t stride, std::int64_t first) {
  std::vector<std::int64_t> frames;
  if (stride <= 0) return frames;
  for (std::int64_t frame = 0; frame + 1 < frame_count; frame += stride)
    if (frame >= first) frames.push_back(frame);
  return frames;
}

std::vector<std::int64_t> probed_frames(const Experiment& experiment, std::string_view name,
                                        std::size_t frame_count) {
  const bool reads_lmds = std::ranges::find(probes(), name, &Probe::name)->reads_lmds;
  return probed_frames(static_cast<std::int64_t>(frame_count), experiment.probe_stride(name),
                       reads_lmds ? experiment.driver.search_latency_frames : 0);
}

}  // namespace lmdbench
