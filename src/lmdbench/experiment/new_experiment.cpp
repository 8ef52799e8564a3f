// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/fcl_probe.h>
#include <lmdbench/experiment/new_experiment.h>
#include <lmdbench/experiment/prepare.h>
#include <lmdbench/motion/tum_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>

namespace lmdbench {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Frames compared with exhaustive truth and with FCL, of the 2,001 of the path.
constexpr int TRUTH_STRIDE = 20;
constexpr int FCL_STRIDE = 50;

/// How a file in `folder` names a mesh.
std::string seen_from(const std::filesystem::path& folder, const std::string& mesh) {
  if (is_mesh_name(mesh)) return mesh;
  const std::string relative = std::filesystem::proximate(mesh, folder).generic_string();
  return relative.find('/') == std::string::npos ? "./" + relative : relative;
}

/// An entry of a mesh with its units guessed.
OrderedJson mesh_entry(const std::string& mesh, const std::filesystem::path& folder,
                       const std::filesystem::path& mesh_folder, const std::string& place,
                       std::vector<DefaultNote>& choices) {
  const double diagonal = bounding_box_diagonal(resolve_mesh(mesh, mesh_folder).mesh);
  OrderedJson entry{{"mesh", seen_from(folder, mesh)}};
  if (diagonal > LARGEST_PLAUSIBLE_DIAGONAL) {
    entry["scale"] = 0.001;
    choices.push_back({place + "/scale", "0.001",
                       fmt::format("coordinates span {:.4g}: taken for millimetres, so {:.4g} m", diagonal,
                                   0.001 * diagonal)});
  } else {
    choices.push_back(
        {place + "/scale", "1", fmt::format("coordinates span {:.4g}: taken for metres", diagonal)});
  }
  entry["centre"] = true;
  return entry;
}

std::string stem_of(const std::string& mesh) {
  std::string stem = std::filesystem::path(mesh).stem().string();
  for (char& c : stem)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') c = '-';
  return stem;
}

}  // namespace

NewExperiment new_experiment(const std::string& moving, const std::string& fixed,
                             const std::filesystem::path& folder, const std::filesystem::path& mesh_folder,
                             const Progress& progress) {
  NewExperiment result;
  result.name = stem_of(moving) + "-" + stem_of(fixed);
  result.name.erase(0, result.name.find_first_not_of("-_"));
  result.experiment_file = folder / (result.name + ".json");
  result.specification_file = folder / (result.name + ".path.json");
  result.path_file = folder / (result.name + ".tum");

  OrderedJson json{{"name", result.name},
                   {"title", fmt::format("{} past {}", stem_of(moving), stem_of(fixed))}};
  if (is_mesh_name(moving) || is_mesh_name(fixed))
    json["mesh_folder"] = std::filesystem::proximate(mesh_folder, folder).generic_string();
  json["moving"] = mesh_entry(moving, folder, mesh_folder, "/moving", result.choices);
  json["fixed"] = OrderedJson::array({mesh_entry(fixed, folder, mesh_folder, "/fixed/0", result.choices)});

  // What the program chooses for a file of two meshes, from the one place that chooses.
  const Experiment open = parse_experiment(json.dump(), result.experiment_file);
  const PreparedRun prepared = prepare(open, progress);
  result.choices.insert(result.choices.end(), prepared.defaults.begin(), prepared.defaults.end());

  json["path"] = {{"file", result.path_file.filename().string()}};
  json["force"] = {{"cutoff_m", prepared.scene().cutoff},
                   {"saturation_cutoff", 0.1},
                   {"maximum_force_n", prepared.profiles.front().force.maximum_force},
                   {"sharpness", prepared.profiles.front().force.sharpness}};
  json["methods"] = OrderedJson::array();
  for (const MethodChoice& method : open.methods)
    json["methods"].push_back(
        {{"name", method.name},
         {"force_law", method.force_law == ForceLaw::LINEAR ? "linear" : "exponential"}});
  json["driver"] = {{"search_every_frames", open.driver.search_every_frames},
                    {"search_latency_frames", open.driver.search_latency_frames},
                    {"repetitions", open.driver.repetitions}};
  json["device"] = open.device;
  json["probes"]["truth"] = {{"stride_frames", TRUTH_STRIDE}};
  result.choices.push_back({"/probes/truth", fmt::format("every {} frames", TRUTH_STRIDE),
                            fmt::format("{} of the path's {} frames", prepared.times.size() / TRUTH_STRIDE,
                                        prepared.times.size())});
  json["probes"]["fcl"] = {{"stride_frames", has_fcl() ? FCL_STRIDE : 0}};
  result.choices.push_back({"/probes/fcl", has_fcl() ? fmt::format("every {} frames", FCL_STRIDE) : "off",
                            has_fcl() ? fmt::format("{} of the path's {} frames",
                                                    prepared.times.size() / FCL_STRIDE, prepared.times.size())
                                      : "this build has no FCL"});
  result.experiment_text = json.dump(2) + "\n";

  PathSpec spec = prepared.made_path->spec;
  spec.moving = {.mesh = json["moving"]["mesh"], .placement = open.moving.placement};
  spec.fixed = {.mesh = json["fixed"][0]["mesh"], .placement = open.fixed.front().placement};
  result.specification_text = path_spec_text(spec);
  result.path_text =
      tum_text(prepared.made_path->path,
               fmt::format("{} past {}, {} {}'", stem_of(moving), stem_of(fixed), GENERATED_PATH_MARK,
                           result.specification_file.filename().string()));
  return result;
}

void write_new_experiment(const NewExperiment& experiment) {
  for (const auto& file : {experiment.experiment_file, experiment.specification_file, experiment.path_file})
    if (std::filesystem::exists(file))
      throw UsageError(file.string(), "", "is there already, and may have been edited",
                       "remove it, or name another folder with --out");
  const std::filesystem::path folder = experiment.experiment_file.parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error)
    throw EnvironmentError(folder.string(), "", "cannot be made: " + error.message(),
                           "name another folder with --out");
  write_file_atomically(experiment.specification_file, experiment.specification_text);
  write_file_atomically(experiment.path_file, experiment.path_text);
  write_file_atomically(experiment.experiment_file, experiment.experiment_text);
}

}  // namespace lmdbench
