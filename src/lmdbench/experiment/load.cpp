// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_document.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/phantom/device.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

template <typename Value>
std::optional<Value> optional_value(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : std::optional<Value>(found->get<Value>());
}

ForceChoice force_choice(const Json& entry, const std::string& place, const std::string& file) {
  ForceChoice force;
  force.name = entry.value("name", "");
  force.cutoff_m = optional_value<double>(entry, "cutoff_m");
  force.cutoff_diagonal = optional_value<double>(entry, "cutoff_diagonal");
  force.saturation_m = optional_value<double>(entry, "saturation_m");
  force.saturation_cutoff = optional_value<double>(entry, "saturation_cutoff");
  force.maximum_force_n = entry["maximum_force_n"].get<double>();
  force.sharpness = entry["sharpness"].get<double>();
  force.aggregation =
      &aggregation_named(entry["aggregation"].get<std::string>(), file, place + "/aggregation");
  force.clip_at_maximum = entry["clip"] == "maximum";
  if (force.saturation_m && force.cutoff_m && *force.saturation_m >= *force.cutoff_m)
    throw UsageError(file, place + "/saturation_m",
                     fmt::format("saturation at {} m is not below the cutoff of {} m", *force.saturation_m,
                                 *force.cutoff_m),
                     "saturate nearer than the cutoff");
  return force;
}

/// `/force`: one profile, or a list of named ones.
std::vector<ForceChoice> force_choices(const Json& entry, const std::string& file) {
  if (entry.is_object()) return {force_choice(entry, "/force", file)};
  std::vector<ForceChoice> profiles;
  std::set<std::string> names;
  for (std::size_t i = 0; i < entry.size(); ++i) {
    const std::string place = fmt::format("/force/{}", i);
    if (!entry[i].is_object())
      throw UsageError(file, place, "a list within the list of profiles", "give the profile itself");
    profiles.push_back(force_choice(entry[i], place, file));
    if (profiles.back().name.empty())
      throw UsageError(file, place, "a profile without a name among several",
                       R"(name it, as in "name": "hard")");
    if (!names.insert(profiles.back().name).second)
      throw UsageError(file, place + "/name",
                       fmt::format("two profiles are called \"{}\"", profiles.back().name),
                       "give one of them another name");
  }
  return profiles;
}

MethodChoice method_choice(const Json& entry) {
  MethodChoice choice;
  choice.name = entry["name"].get<std::string>();
  choice.entry = choice.label = entry["label"].get<std::string>();
  choice.force_law = force_law_named(entry["force_law"].get<std::string>());
  choice.options_json = entry.dump();
  for (const auto& option : method_description(choice.name).options.items())
    choice.options[option.key()] = entry[option.key()];
  return choice;
}

/// Called before the validator, which could only list the names of methods.
void check_method_names(const Json& document, const std::string& file) {
  if (!document.is_object() || !document.contains("methods") || !document["methods"].is_array()) return;
  const Json& methods = document["methods"];
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (methods[i].is_object() && methods[i].contains("name") && methods[i]["name"].is_string())
      method_description(methods[i]["name"].get<std::string>(), file, fmt::format("/methods/{}/name", i));
}

/// Adds methods that the file does not name, with default options.
void add_methods(Json& document, const std::vector<std::string>& names) {
  if (!document.is_object() || !document.contains("methods") || !document["methods"].is_array()) return;
  Json& methods = document["methods"];
  for (const std::string& name : names)
    if (std::ranges::none_of(methods, [&](const Json& method) {
          return method.is_object() && method.contains("name") && method["name"] == name;
        }))
      methods.push_back({{"name", name}});
}

/// @param entries number of entries in the file; each appears once a profile
void check_labels(const std::vector<MethodChoice>& methods, std::size_t entries, const std::string& file) {
  std::set<std::string> labels;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (!labels.insert(methods[i].label).second)
      throw UsageError(file, fmt::format("/methods/{}/label", i % entries),
                       fmt::format("two methods are called \"{}\"", methods[i].label),
                       "give one of them another \"label\"");
  }
}

Experiment from_json(Json document, const std::filesystem::path& path) {
  const std::string file = path.string();
  for (Json& method : document["methods"])
    if (!method.contains("label")) method["label"] = method["name"];

  Experiment experiment;
  experiment.file = path;
  experiment.name = document["name"].get<std::string>();
  experiment.title = document["title"].get<std::string>();
  experiment.mesh_folder = document.contains("mesh_folder")
                               ? shortened(path.parent_path() / document["mesh_folder"].get<std::string>())
                               : default_mesh_folder(shortened(path.parent_path() / ".." / "meshes"));
  experiment.objects = read_objects(document, path);
  experiment.frame_rate_hz = document["frame_rate_hz"].get<double>();
  experiment.frames = optional_value<std::int64_t>(document, "frames");
  experiment.device = document["device"].get<std::string>();
  // Before the forces, whose default is the device's.
  const Device& device = device_named(experiment.device, file, "/device");
  experiment.profiles = force_choices(document["force"], file);
  for (std::size_t profile = 0; profile < experiment.profiles.size(); ++profile) {
    for (const Json& method : document["methods"]) {
      MethodChoice choice = method_choice(method);
      choice.profile = profile;
      choice.aggregation = experiment.profiles[profile].aggregation;
      if (choice.aggregation->needs != AggregationNeeds::MINIMA &&
          !method_description(choice.name).finds_critical_pairs)
        choice.aggregation = &sum_law();
      if (document["force"].is_array()) choice.label += "-" + experiment.profiles[profile].name;
      experiment.methods.push_back(std::move(choice));
    }
  }
  check_labels(experiment.methods, document["methods"].size(), file);
  const Json& driver = document["driver"];
  experiment.driver = {driver["search_every_frames"].get<std::int64_t>(),
                       driver["search_latency_frames"].get<std::int64_t>(),
                       driver["repetitions"].get<std::int64_t>(), driver["block_frames"].get<std::int64_t>(),
                       driver["prediction"] == "linear"};
  if (experiment.driver.search_latency_frames > experiment.driver.search_every_frames)
    throw UsageError(
        file, "/driver/search_latency_frames",
        fmt::format("a search takes {} frames, but the next one starts after {}",
                    experiment.driver.search_latency_frames, experiment.driver.search_every_frames),
        "one thread searches: let the latency be at most search_every_frames");
  if (driver["kind"] == "realtime") {
    experiment.realtime = realtime_choice(driver["realtime"]);
    // Traversals differ, and the search thread itself decides when a search starts.
    experiment.driver.repetitions = experiment.driver.search_every_frames = 1;
    experiment.driver.search_latency_frames = 0;
  }
  experiment.loop = loop_choice(document["loop"], device, file);
  read_probes(experiment, document);
  experiment.acceptance = read_acceptance(document["limits"], experiment, file);
  experiment.rules = read_rule_switches(document["plan"]);
  experiment.record_frames = document["record"]["frames"].get<bool>();
  experiment.record_counters = document["record"]["counters"].get<bool>();
  experiment.record_timings = document["record"]["timings"].get<bool>();
  experiment.record_torque = document["record"]["torque"].get<bool>();
  experiment.record_lmds = document["record"]["lmds"].get<bool>();
  const ObjectMotion& held = experiment.held().motion;
  if (experiment.is_world() && held.path_file.empty())
    throw UsageError(file, held.path_place, "no path is made among instances",
                     "name a path (paths/README.md)");
  // Removes defaults of the schema for keys that the file does not use.
  if (document.contains("movers") && document["movers"].empty()) document.erase("movers");
  if (held.path_place != "/path/file") document.erase("path");
  experiment.resolved_json = document.dump(2);
  return experiment;
}

}  // namespace

bool MethodChoice::counts_indices() const {
  return aggregation->needs != AggregationNeeds::MINIMA;
}

void refuse_deformation(const Experiment& experiment) {
  for (const ObjectChoice& object : experiment.objects)
    if (object.deformation)
      throw UsageError(experiment.file.string(), object.deformation->place,
                       "the mesh deforms, and this looks at meshes at rest",
                       "leave the deformation out; run, plan, compare, report and export follow it");
}

void refuse_movers(const Experiment& experiment) {
  for (const ObjectChoice& object : experiment.objects)
    if (&object != &experiment.held() && !object.stands())
      throw UsageError(experiment.file.string(), object.place,
                       "a mesh moves beside the moving one, and this looks at one that moves",
                       "leave it out; run, plan, compare, report and export know such scenes");
}

std::optional<double> ForceChoice::cutoff(double moving_diagonal) const {
  if (cutoff_m) return cutoff_m;
  return cutoff_diagonal ? std::optional(*cutoff_diagonal * moving_diagonal) : std::nullopt;
}

double ForceChoice::saturation(double cutoff) const {
  if (saturation_m) return *saturation_m;
  return saturation_cutoff ? *saturation_cutoff * cutoff : 0.0;
}

Experiment parse_experiment(const std::string& text, const std::filesystem::path& file,
                            const std::vector<Override>& overrides, const std::vector<std::string>& also) {
  std::vector<DefaultNote> defaults;
  const JsonDocument document(text, file.string(), experiment_schema(), ExitCode::USAGE, overrides,
                              [&](Json& json) {
                                check_scene_keys(json, file.string());
                                check_method_names(json, file.string());
                                defaults = add_file_defaults(json, file);
                                add_methods(json, also);
                              });
  Experiment experiment = document.locate([&] { return from_json(document.json(), file); });
  experiment.defaults = std::move(defaults);
  experiment.notes = document.notes();
  return experiment;
}

Experiment load_experiment(const std::filesystem::path& file, const std::vector<Override>& overrides,
                           const std::vector<std::string>& also) {
  const InputKind kind{.what = "experiment file", .code = ExitCode::USAGE, .most_bytes = Limit::JSON_BYTES};
  return parse_experiment(read_input_file(file, kind).bytes, file, overrides, also);
}

}  // namespace lmdbench
