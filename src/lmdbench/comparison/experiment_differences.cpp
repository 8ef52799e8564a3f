// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/comparison/experiment_differences.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

namespace lmdbench {
namespace {

std::map<std::string, std::string> input_hashes(const ResultReader& file) {
  const std::vector<std::string> roles = file.texts("/provenance/inputs/role");
  const std::vector<std::string> hashes = file.texts("/provenance/inputs/sha256");
  std::map<std::string, std::string> by_role;
  for (std::size_t i = 0; i < std::min(roles.size(), hashes.size()); ++i) by_role[roles[i]] = hashes[i];
  return by_role;
}

nlohmann::json experiment_of(const ResultReader& file) {
  nlohmann::json experiment = recorded_experiment(file);
  if (!experiment.is_object())
    throw InputError(file.file().string(), EXPERIMENT, "is no JSON object",
                     "make the file again with lmdbench run");
  return experiment;
}

/// `moving`, `fixed`, `movers` and `path` in place of `objects` (experiment/objects.cpp).
void tell_by_kind(nlohmann::json& experiment) {
  const nlohmann::json objects = experiment.value("objects", nlohmann::json());
  if (!objects.is_array()) return;
  experiment.erase("objects");
  for (nlohmann::json object : objects) {
    if (!object.is_object()) continue;
    object.erase("name");
    nlohmann::json motion = object.value("motion", nlohmann::json());
    object.erase("motion");
    if (motion.is_object()) {
      if (const nlohmann::json sway = motion.value("sway", nlohmann::json()); sway.is_object())
        motion.update(sway);
      if (motion.erase("path") > 0) motion["file"] = true;
      motion.erase("sway");
    }
    if (!experiment.contains("moving")) {
      object.erase("pose");
      experiment["moving"] = object;
      if (motion.is_object()) experiment["path"] = motion;
    } else if (motion.is_object()) {
      object["path"] = motion;
      experiment["movers"].push_back(object);
    } else {
      experiment["fixed"].push_back(object);
    }
  }
}

/// The part of the experiment that decides results and times, with one form for each scene.
nlohmann::json deciding_part(const ResultReader& file) {
  nlohmann::json experiment = experiment_of(file);
  for (const char* key : {"$schema", "name", "title", "mesh_folder", "probes", "record", "limits"})
    experiment.erase(key);
  tell_by_kind(experiment);
  // Of a file its SHA-256 is compared, not its name and place: of a mesh with the scene, of a path
  // and of vertices beside it.
  const std::map<std::string, std::string> inputs = input_hashes(file);
  const auto tell_mesh = [&](nlohmann::json& mesh) {
    if (!mesh.is_object()) return;
    if (const nlohmann::json name = mesh.value("mesh", nlohmann::json()); name.is_string()) {
      const auto found = inputs.find("mesh:" + name.get<std::string>());
      if (found != inputs.end()) mesh["mesh"] = found->second;
    }
    if (!mesh.contains("deformation") || !mesh["deformation"].is_object()) return;
    nlohmann::json& deformation = mesh["deformation"];
    if (deformation.erase("files") + deformation.erase("folder") > 0) deformation["files"] = true;
  };
  const auto tell_path = [](nlohmann::json& owner) {
    if (owner.is_object() && owner.contains("path") && owner["path"].is_object() &&
        owner["path"].erase("file") > 0)
      owner["path"]["file"] = true;
  };
  if (experiment.contains("path") && experiment["path"].is_object()) experiment["path"].erase("file");
  if (experiment.contains("movers") && experiment["movers"].empty()) experiment.erase("movers");
  if (experiment.contains("moving")) tell_mesh(experiment["moving"]);
  for (const char* kind : {"fixed", "movers"}) {
    if (!experiment.contains(kind)) continue;
    std::ranges::for_each(experiment[kind], tell_mesh);
    std::ranges::for_each(experiment[kind], tell_path);
  }
  if (experiment.contains("driver") && experiment["driver"].is_object())
    experiment["driver"].erase("repetitions");
  nlohmann::json by_label = nlohmann::json::object();
  for (const nlohmann::json& method : experiment["methods"])
    if (method.is_object()) by_label[method.value("label", method.value("name", ""))] = method;
  experiment["methods"] = by_label;
  return experiment;
}

/// Whether a key has no default: without it an experiment says something else, whatever the version
/// that wrote it.
bool is_optional(const std::string& key) {
  constexpr std::string_view KEYS[] = {
      "frames",  "cutoff_m",    "cutoff_diagonal", "saturation_m", "saturation_cutoff",
      "movers",  "deformation", "instances",       "diagonal_m",   "scale",
      "centre",  "generator",   "files",           "file",         "way_diagonals",
      "turn_rad"};
  return std::ranges::find(KEYS, key) != std::end(KEYS);
}

/// First different values among keys of both sides, and optional ones of either; methods of one
/// side are compared elsewhere.
void compare_json(const nlohmann::json& base, const nlohmann::json& candidate, const std::string& pointer,
                  std::vector<Difference>& differences) {
  const auto differ = [&](const std::string& place, const nlohmann::json& a, const nlohmann::json& b) {
    differences.push_back({"", EXPERIMENT + std::string(":") + place, std::nullopt, a, b, 0});
  };
  if (base.is_object() && candidate.is_object()) {
    for (const auto& [key, value] : base.items()) {
      const std::string place = fmt::format("{}/{}", pointer, key);
      if (candidate.contains(key))
        compare_json(value, candidate[key], place, differences);
      else if (is_optional(key))
        differ(place, value, ABSENT);
    }
    for (const auto& [key, value] : candidate.items())
      if (!base.contains(key) && is_optional(key)) differ(fmt::format("{}/{}", pointer, key), ABSENT, value);
    return;
  }
  if (base.is_array() && candidate.is_array() && base.size() == candidate.size()) {
    for (std::size_t i = 0; i < base.size(); ++i)
      compare_json(base[i], candidate[i], fmt::format("{}/{}", pointer, i), differences);
    return;
  }
  if (base != candidate) differ(pointer, base, candidate);
}

void compare_inputs(const ResultReader& base, const ResultReader& candidate,
                    std::vector<Difference>& differences) {
  const std::map<std::string, std::string> other = input_hashes(candidate);
  for (const auto& [role, hash] : input_hashes(base)) {
    const auto found = other.find(role);
    if (found != other.end() && found->second != hash)
      differences.push_back({"", "/provenance/inputs/sha256:" + role, std::nullopt, hash, found->second, 0});
  }
}

/// Null where there is none.
nlohmann::json attribute(const ResultReader& file, const std::string& object, const std::string& name) {
  const std::optional<ElementKind> kind = file.attribute_kind(object, name);
  if (!kind) return nullptr;
  switch (*kind) {
    case ElementKind::REAL:
      return *file.real_attribute(object, name);
    case ElementKind::INTEGER:
      return *file.integer_attribute(object, name);
    case ElementKind::TEXT:
      break;
  }
  return *file.text_attribute(object, name);
}

/// Attributes of /scene and of its meshes, except a mesh's name, which does not matter, and its
/// `validity`, which its SHA-256 covers.
void compare_scene(const ResultReader& base, const ResultReader& candidate, const std::string& group,
                   std::vector<Difference>& differences) {
  for (const std::string& name : base.attributes(group)) {
    if (name == "validity" || name == "mesh") continue;
    nlohmann::json a = attribute(base, group, name), b = attribute(candidate, group, name);
    if (!b.is_null() && a != b)
      differences.push_back(
          {"", fmt::format("{}:{}", group, name), std::nullopt, std::move(a), std::move(b), 0});
  }
  for (const std::string& mesh : base.groups(group)) {
    if (mesh == "objects") continue;  // names; their meshes have groups
    const std::string path = fmt::format("{}/{}", group, mesh);
    if (candidate.has(path))
      compare_scene(base, candidate, path, differences);
    else
      differences.push_back({"", path, std::nullopt, PRESENT, ABSENT, 0});
  }
}

}  // namespace

std::vector<Difference> experiment_differences(const ResultReader& base, const ResultReader& candidate) {
  std::vector<Difference> differences;
  nlohmann::json a = deciding_part(base), b = deciding_part(candidate);
  // All frames of the path, where one side alone names a number.
  if (a.contains("frames") != b.contains("frames"))
    for (const auto& [part, file] : {std::pair{&a, &base}, {&b, &candidate}})
      if (!part->contains("frames") && file->has("/path/time"))
        (*part)["frames"] = file->reals("/path/time").size();
  compare_json(a, b, "", differences);
  compare_inputs(base, candidate, differences);
  return differences;
}

std::vector<Difference> kept_differences(const ResultReader& base, const ResultReader& candidate) {
  std::vector<Difference> differences;
  const nlohmann::json a = experiment_of(base), b = experiment_of(candidate);
  for (const char* key : {"probes", "record"})
    if (a.contains(key) && b.contains(key))
      compare_json(a[key], b[key], fmt::format("/{}", key), differences);
  return differences;
}

bool is_of_frames(const Difference& difference) {
  constexpr std::string_view KEYS[] = {"/moving", "/fixed", "/movers", "/path", "/frame_rate_hz", "/frames"};
  const std::string in_experiment = EXPERIMENT + std::string(":");
  if (!difference.dataset.starts_with(in_experiment)) return true;  // a file's SHA-256
  const std::string pointer = difference.dataset.substr(in_experiment.size());
  return std::ranges::find(KEYS, pointer.substr(0, pointer.find('/', 1))) != std::end(KEYS);
}

std::vector<Difference> scene_differences(const ResultReader& base, const ResultReader& candidate) {
  std::vector<Difference> differences;
  compare_scene(base, candidate, "/scene", differences);
  std::vector<std::string> groups{"/path"};
  for (const std::string& mesh : base.groups("/scene"))
    if (mesh != "objects" && candidate.has("/scene/" + mesh)) groups.push_back("/scene/" + mesh);
  for (const std::string& group : groups)
    std::ranges::move(group_differences(base, candidate, group), std::back_inserter(differences));
  return differences;
}

namespace {

constexpr const char* MACHINE = "/provenance/machine";

/// Facts that decide how fast the same instructions run. Usable processors, memory and kernel
/// change times by less than the noise.
constexpr const char* DECISIVE[] = {"processor",
                                    "processor_family_model_stepping",
                                    "logical_processors",
                                    "simd",
                                    "virtual_machine",
                                    "l1_data_cache_bytes",
                                    "l2_cache_bytes",
                                    "l3_cache_bytes",
                                    "frequency_governor",
                                    "frequency_boost",
                                    "simultaneous_multithreading"};

void compare_attribute(const ResultReader& a, const ResultReader& b, const std::string& group,
                       const std::string& name, std::vector<std::string>& differences) {
  const std::string first = a.text_attribute(group, name).value_or("unknown");
  const std::string second = b.text_attribute(group, name).value_or("unknown");
  if (first != second) differences.push_back(fmt::format("{}: '{}' and '{}'", name, first, second));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_of(const ResultReader& file) {
  std::vector<std::pair<std::string, std::string>> facts;
  for (const std::string& name : file.attributes(MACHINE))
    facts.emplace_back(name, file.text_attribute(MACHINE, name).value_or("unknown"));
  return facts;
}

std::vector<std::string> machine_differences(const ResultReader& a, const ResultReader& b) {
  std::vector<std::string> differences;
  for (const char* name : DECISIVE) compare_attribute(a, b, MACHINE, name, differences);
  return differences;
}

std::vector<std::string> build_differences(const ResultReader& a, const ResultReader& b) {
  std::vector<std::string> differences;
  for (const char* name : {"compiler", "compiler_flags", "build_type"})
    compare_attribute(a, b, "/provenance", name, differences);
  for (const std::string& library : a.attributes("/provenance/libraries"))
    compare_attribute(a, b, "/provenance/libraries", library, differences);
  for (const char* name : {"kernel", "operating_system"}) compare_attribute(a, b, MACHINE, name, differences);
  return differences;
}

}  // namespace lmdbench
