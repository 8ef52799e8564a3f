// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/plain_name.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/experiment/defaults.h>
#include <lmdbench/experiment/probe.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/phantom/device.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

constexpr const char* USUAL_DEVICE = "phantom-desktop";
/// For a device without a limit [N].
constexpr double USUAL_FORCE = 1.0;

/// A file's name as a valid name of an experiment.
std::string name_from(const std::filesystem::path& file) {
  const std::string name = plain_name(file.stem().string(), "_-.");
  return name.empty() ? "experiment" : name;
}

void add_every_method(Json& document, std::vector<DefaultNote>& notes) {
  std::vector<std::string> names;
  document["methods"] = Json::array();
  for (const MethodDescription& method : method_descriptions()) {
    if (method.brute_force) continue;
    names.push_back(method.name);
    document["methods"].push_back({{"name", method.name}});
  }
  notes.push_back({"/methods", fmt::format("{}", fmt::join(names, ", ")),
                   "every method but those that look at all pairs, under one force law"});
}

void add_force(Json& document, std::vector<DefaultNote>& notes) {
  Json& force = document["force"];
  if (force.is_null()) force = Json::object();
  const Json device = document.value("device", Json(USUAL_DEVICE));
  if (!device.is_string()) return;
  const auto devices = known_devices();
  const auto known = std::find_if(devices.begin(), devices.end(),
                                  [&](const Device& d) { return d.name == device.get<std::string>(); });
  if (known == devices.end()) return;  // reported where the device is used
  const double continuous = known->continuous_force.value;
  const bool limited = std::isfinite(continuous);
  const auto complete = [&](Json& profile, const std::string& place) {
    if (!profile.is_object() || profile.contains("maximum_force_n")) return;
    profile["maximum_force_n"] = limited ? continuous : USUAL_FORCE;
    notes.push_back({place + "/maximum_force_n", fmt::format("{:g} N", limited ? continuous : USUAL_FORCE),
                     limited ? fmt::format("what the {} can hold for long", known->title)
                             : fmt::format("the {} has no limit", known->title)});
  };
  complete(force, "/force");
  if (force.is_array())
    for (std::size_t i = 0; i < force.size(); ++i) complete(force[i], fmt::format("/force/{}", i));
}

}  // namespace

std::vector<DefaultNote> add_file_defaults(Json& document, const std::filesystem::path& file) {
  std::vector<DefaultNote> notes;
  if (!document.is_object()) return notes;
  if (!document.contains("name")) {
    document["name"] = name_from(file);
    notes.push_back({"/name", document["name"], "the file's name"});
  }
  if (!document.contains("methods")) add_every_method(document, notes);
  add_force(document, notes);
  // The schema's defaults assume more; a file without path and probes is a first look.
  if (!document.contains("probes") && !document.contains("path") &&
      !document.contains(Json::json_pointer("/objects/0/motion")))
    for (const Probe& probe : probes())
      if (probe.parent == "/probes")
        document["probes"][probe.name] = {{"stride_frames", probe.first_stride_frames}};
  return notes;
}

double default_cutoff(const Scene& scene, std::vector<DefaultNote>& notes) {
  double diagonal = scene.moving->diagonal();
  double edge = mean_edge_length(scene.moving->surface().mesh);
  for (const auto& fixed : scene.fixed) {
    diagonal = std::min(diagonal, fixed->diagonal());
    edge = std::max(edge, mean_edge_length(fixed->surface().mesh));
  }
  const double by_size = DEFAULT_CUTOFF_DIAGONALS * diagonal;
  const double by_edges = DEFAULT_CUTOFF_EDGES * edge;
  // Three digits are easy to say and to write into a file.
  const double cutoff = to_significant_digits(std::min(by_size, by_edges), 3);
  notes.push_back(
      {"/force/cutoff_m", fmt::format("{:g} m", cutoff),
       by_size <= by_edges
           ? fmt::format("{:g} % of the smaller mesh's diagonal, {:.4g} m", 100.0 * DEFAULT_CUTOFF_DIAGONALS,
                         diagonal)
           : fmt::format("{:g} mean edges of the coarser mesh, {:.4g} m each; less than {:g} % of "
                         "the smaller mesh's diagonal",
                         DEFAULT_CUTOFF_EDGES, edge, 100.0 * DEFAULT_CUTOFF_DIAGONALS)});
  return cutoff;
}

std::string defaults_text(const std::vector<DefaultNote>& notes) {
  std::string text;
  for (const DefaultNote& note : notes)
    text += fmt::format("default: {} is {} ({})\n", note.key, note.value, note.from);
  return text;
}

nlohmann::ordered_json defaults_json(const std::vector<DefaultNote>& notes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const DefaultNote& note : notes)
    json.push_back({{"key", note.key}, {"value", note.value}, {"from", note.from}});
  return json;
}

}  // namespace lmdbench
