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

constexpr const char* EXPERIMENT = "/provenance/experiment";

std::map<std::string, std::string> input_hashes(const ResultReader& file) {
  const std::vector<std::string> roles = file.texts("/provenance/inputs/role");
  const std::vector<std::string> hashes = file.texts("/provenance/inputs/sha256");
  std::map<std::string, std::string> by_role;
  for (std::size_t i = 0; i < std::min(roles.size(), hashes.size()); ++i) by_role[roles[i]] = hashes[i];
  return by_role;
}

/// The part of the experiment that decides results.
nlohmann::json deciding_part(const ResultReader& file) {
  const std::vector<std::string> texts = file.texts(EXPERIMENT);
  nlohmann::json experiment = nlohmann::json::parse(texts.empty() ? "" : texts.front(), nullptr, false);
  if (!experiment.is_object())
    throw InputError(file.file().string(), EXPERIMENT, "is no JSON object",
                     "make the file again with lmdbench run");
  for (const char* key : {"$schema", "name", "title", "mesh_folder", "probes", "record"})
    experiment.erase(key);
  if (experiment["path"].is_object()) experiment["path"].erase("file");  // its SHA-256 is compared
  if (experiment["driver"].is_object()) {
    experiment["driver"].erase("repetitions");
    experiment["driver"].erase("block_frames");
  }
  // Of a file its content matters, not its name and place. A mesh without a deformation, also in
  // old files, differs from one with it. The files with the vertices do not matter: their SHA-256
  // is compared.
  const std::map<std::string, std::string> inputs = input_hashes(file);
  const auto tell_mesh = [&](nlohmann::json& mesh) {
    if (!mesh.is_object()) return;
    if (const nlohmann::json name = mesh.value("mesh", nlohmann::json()); name.is_string()) {
      const auto found = inputs.find("mesh:" + name.get<std::string>());
      if (found != inputs.end()) mesh["mesh"] = found->second;
    }
    nlohmann::json& deformation = mesh["deformation"];
    if (!deformation.is_object()) return;
    if (deformation.erase("files") + deformation.erase("folder") > 0) deformation["files"] = true;
  };
  tell_mesh(experiment["moving"]);
  if (experiment["fixed"].is_array()) std::ranges::for_each(experiment["fixed"], tell_mesh);
  // No movers, also in old files, is another scene than some.
  nlohmann::json& movers = experiment["movers"];
  if (movers.is_array())
    for (nlohmann::json& mover : movers)
      if (mover.is_object() && mover["path"].is_object() && mover["path"].erase("file") > 0)
        mover["path"]["file"] = true;
  if (nlohmann::json& objects = experiment["objects"]; objects.is_array())
    for (nlohmann::json& object : objects) {
      tell_mesh(object);
      if (object.is_object() && object["motion"].is_object() && object["motion"].contains("path"))
        object["motion"]["path"] = true;
    }
  nlohmann::json by_label = nlohmann::json::object();
  for (const nlohmann::json& method : experiment["methods"])
    if (method.is_object()) by_label[method.value("label", method.value("name", ""))] = method;
  experiment["methods"] = by_label;
  return experiment;
}

/// First different values among keys of both sides; methods of one side are compared elsewhere.
void compare_json(const nlohmann::json& base, const nlohmann::json& candidate, const std::string& pointer,
                  std::vector<Difference>& differences) {
  if (base.is_object() && candidate.is_object()) {
    for (const auto& [key, value] : base.items())
      if (candidate.contains(key))
        compare_json(value, candidate[key], fmt::format("{}/{}", pointer, key), differences);
    return;
  }
  if (base.is_array() && candidate.is_array() && base.size() == candidate.size()) {
    for (std::size_t i = 0; i < base.size(); ++i)
      compare_json(base[i], candidate[i], fmt::format("{}/{}", pointer, i), differences);
    return;
  }
  if (base != candidate)
    differences.push_back({"", EXPERIMENT + std::string(":") + pointer, std::nullopt, base, candidate, 0});
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
      differences.push_back({"", path, std::nullopt, "present", "absent", 0});
  }
}

}  // namespace

std::vector<Difference> experiment_differences(const ResultReader& base, const ResultReader& candidate) {
  std::vector<Difference> differences;
  compare_json(deciding_part(base), deciding_part(candidate), "", differences);
  compare_inputs(base, candidate, differences);
  return differences;
}

bool is_of_frames(const Difference& difference) {
  constexpr std::string_view KEYS[] = {"/moving", "/fixed",         "/movers", "/objects",
                                       "/path",   "/frame_rate_hz", "/frames"};
  const std::string in_experiment = EXPERIMENT + std::string(":");
  if (!difference.dataset.starts_with(in_experiment)) return true;  // a file's SHA-256
  const std::string pointer = difference.dataset.substr(in_experiment.size());
  return std::ranges::find(KEYS, pointer.substr(0, pointer.find('/', 1))) != std::end(KEYS);
}

std::vector<Difference> scene_differences(const ResultReader& base, const ResultReader& candidate) {
  std::vector<Difference> differences;
  compare_scene(base, candidate, "/scene", differences);
  for (Difference& difference : group_differences(base, candidate, "/path"))
    differences.push_back(std::move(difference));
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
