// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/plain_name.h>
#include <lmdbench/base/printable_text.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/mesh/self_intersections.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/prepare/new_experiment.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/prepare/resting_pose.h>
#include <lmdbench/prepare/scene_look.h>
#include <lmdbench/shape/flatten.h>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <tuple>

namespace lmdbench {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Of an experiment that begins at rest in contact.
constexpr const char* CONTACT_HAND = "postural-arm";
constexpr double CONTACT_SECONDS = 1.0;

/// Relative, so that folders can move together. Of absolute names: a file that does not exist yet
/// has no canonical path.
std::string path_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  return std::filesystem::proximate(std::filesystem::absolute(file), std::filesystem::absolute(folder))
      .generic_string();
}

/// How a file in `folder` names a mesh.
std::string seen_from(const std::filesystem::path& folder, const std::string& mesh) {
  if (is_mesh_name(mesh)) return mesh;
  const std::string relative = path_from(folder, mesh);
  return relative.find('/') == std::string::npos ? "./" + relative : relative;
}

std::string stem_of(const std::string& mesh) {
  return plain_name(std::filesystem::path(mesh).stem().string(), "_");
}

/// A mesh of the new scene.
struct GivenMesh {
  std::string name;   ///< As the user gave it.
  std::string place;  ///< JSON pointer of its entry.
  ResolvedMesh mesh;
  double diagonal = 0.0;  ///< In the file's unit.
  double metres = 1.0;    ///< Of that unit.
  std::string why;
};

GivenMesh part_of(const std::string& name, const std::string& place,
                  const std::filesystem::path& mesh_folder) {
  GivenMesh part{name, place, resolve_mesh(name, mesh_folder), 0.0, 1.0, {}};
  part.diagonal = bounding_box_diagonal(part.mesh.mesh);
  return part;
}

/// One decision for both: parts that meet come from one drawing far more often than from two.
void choose_units(GivenMesh& moving, GivenMesh& fixed, const std::optional<std::string>& unit,
                  std::vector<std::string>& warnings) {
  if (unit) {
    std::tie(moving.metres, fixed.metres) = metres_of_units(*unit, "--unit");
    moving.why = fixed.why = "--unit " + *unit;
  } else {
    const auto known = [](const GivenMesh& part) {
      return part.mesh.file ? metres_of_format(part.name) : std::optional(1.0);
    };
    double longest = 0.0;  // of coordinates without a known unit
    for (const GivenMesh* part : {&moving, &fixed})
      if (!known(*part)) longest = std::max(longest, part->diagonal);
    const bool millimetres = longest > LARGEST_PLAUSIBLE_DIAGONAL;
    for (GivenMesh* part : {&moving, &fixed}) {
      part->metres = known(*part).value_or(millimetres ? 0.001 : 1.0);
      part->why = !part->mesh.file ? "the manifest's shapes are in metres"
                  : known(*part)   ? "glTF is in metres"
                  : millimetres
                      ? fmt::format("a file's coordinates span {:.4g}: {} for millimetres", longest,
                                    known(moving) || known(fixed) ? "they are taken" : "both are taken")
                      : "no file's coordinates span more than a few metres";
    }
    if (millimetres && 0.001 * longest > UNLIKELY_SIZE)
      warnings.push_back(
          fmt::format("in millimetres a part is {:.4g} m large (remedy: say another unit, such as --unit um, "
                      "or --unit mm)",
                      0.001 * longest));
  }
  const double a = moving.metres * moving.diagonal;
  const double b = fixed.metres * fixed.diagonal;
  if (!unit && std::max(a, b) > UNLIKELY_SIZE_RATIO * std::min(a, b))
    throw UsageError(
        "", "--unit",
        fmt::format(
            "{} would be {:.4g} m large and {} {:.4g} m, more than {:g} times apart: they are likely in "
            "different units",
            moving.name, a, fixed.name, b, UNLIKELY_SIZE_RATIO),
        "say what a unit of their coordinates is: --unit mm for both, --unit mm,m for the moving and the "
        "fixed one");
}

OrientationChoice choose_orientation(const GivenMesh& part, const std::optional<OrientationChoice>& chosen,
                                     std::vector<DefaultNote>& choices) {
  if (chosen) {
    choices.push_back({part.place + "/orient", std::string(to_string(*chosen)), "--orient"});
    return *chosen;
  }
  const ValidityReport report = check_mesh(build_surface(part.mesh.mesh));
  if (report.outward != false && report.misoriented_edges == 0) return OrientationChoice::KEEP;
  TriangleMesh turned = part.mesh.mesh;
  choices.push_back(
      {part.place + "/orient", "outward",
       (report.outward == false ? "inside out in the file: " : "its triangles disagree on the outer side: ") +
           to_text(orient_outward(turned))});
  return OrientationChoice::OUTWARD;
}

/// Whether the meshes stay at their files' places.
bool choose_places(const GivenMesh& moving, const GivenMesh& fixed, const InitChoices& chosen,
                   std::vector<DefaultNote>& choices) {
  const auto box_of = [](const GivenMesh& part) {
    Eigen::AlignedBox3d box;
    for (const Vec3& vertex : part.mesh.mesh.vertices) box.extend(part.metres * vertex);
    return box;
  };
  const double smaller = std::min(moving.metres * moving.diagonal, fixed.metres * fixed.diagonal);
  const bool is_assembly = !is_mesh_name(moving.name) && !is_mesh_name(fixed.name) &&
                           moving.metres == fixed.metres &&
                           box_of(moving).exteriorDistance(box_of(fixed)) < smaller;
  const bool keep = chosen.keep_place.value_or(is_assembly);
  const char* why = chosen.keep_place ? "--place"
                    : is_assembly
                        ? "the files place the parts in or next to each other, as in one assembly: the "
                          "identity as a pose is that place; --place centre has each about its own middle"
                        : "the files place the parts apart, or in no common frame; --place keep leaves "
                          "them there";
  for (const GivenMesh* part : {&moving, &fixed})
    choices.push_back(
        {part->place + "/centre", keep ? "false" : "true", part == &moving ? why : "as the moving one"});
  return keep;
}

/// Flaws that no method can mend, with remedies, of the mesh as a run takes it.
void tell_flaws(const GivenMesh& part, std::vector<std::string>& warnings) {
  std::vector<std::string> flaws;
  TriangleMesh mesh = part.mesh.mesh;
  flatten(mesh);
  const ValidityReport report = check_mesh(build_surface(mesh));
  if (!report.closed)
    flaws.push_back(fmt::format("{} boundary edges in {} holes: what is behind them is outside, too",
                                report.boundary_edges, report.boundary_loops));
  if (!report.manifold)
    flaws.push_back(fmt::format("{} edges and vertices where more than two triangles or surfaces meet",
                                report.non_manifold_edges + report.non_manifold_vertices));
  const SelfIntersections crossings = self_intersections(mesh);
  if (crossings.pairs > 0)
    flaws.push_back(to_text(crossings) + ": parts of its surface are inside of it and push all the same");
  for (const std::string& flaw : flaws)
    warnings.push_back(
        fmt::format("{}: {} (remedy: mend it where it was made; `lmdbench mesh info {}` says more)",
                    part.name, flaw, part.name));
}

/// A mesh's entry in the experiment.
OrderedJson mesh_entry(const GivenMesh& part, bool keep_place, const InitChoices& chosen,
                       const std::filesystem::path& folder, std::vector<DefaultNote>& choices) {
  OrderedJson entry{{"mesh", seen_from(folder, part.name)}};
  if (part.metres != 1.0 || chosen.unit) entry["scale"] = part.metres;
  choices.push_back(
      {part.place + "/scale", fmt::format("{:g}", part.metres),
       fmt::format("{}; {:.4g} of them are {:.4g} m", part.why, part.diagonal, part.metres * part.diagonal)});
  if (!keep_place) entry["centre"] = true;
  if (choose_orientation(part, chosen.orientation, choices) == OrientationChoice::OUTWARD)
    entry["orient"] = "outward";
  return entry;
}

/// Closed loop at rest; `lmdbench stability` computes the pressing force.
void write_contact(NewExperiment& result, OrderedJson& json, const Scene& scene, const Experiment& open,
                   const Progress& progress) {
  ForceProfile profile;
  profile.cutoff = scene.cutoff;
  profile.saturation_distance = open.profiles.front().saturation(scene.cutoff);
  profile.maximum_force = open.profiles.front().maximum_force_n;
  profile.sharpness = open.profiles.front().sharpness;
  profile.law = open.methods.front().force_law;
  const RestingPose rest = find_resting_pose(scene, profile, progress);
  result.choices.push_back(
      {"/path/file",
       fmt::format("at rest with {} LMD{}, {:.3g} m apart", rest.contacts, rest.contacts == 1 ? "" : "s",
                   rest.gap),
       rest.slides()
           ? fmt::format("the best of {} poses; it slides off unless the hand holds it (lateral stiffness "
                         "{:.2g} of K_eff)",
                         rest.tried, rest.least_stiffness_share)
           : fmt::format("of {} poses that the contact holds from all sides, the one with the most contacts",
                         rest.tried)});
  json["title"] =
      fmt::format("{} at rest on {}", stem_of(json["moving"]["mesh"]), stem_of(json["fixed"][0]["mesh"]));
  const Vec3 push_W = -rest.force_W;
  result.press = fmt::format("/loop/push_n=[{:.6g},{:.6g},{:.6g}]", push_W.x(), push_W.y(), push_W.z());
  json["methods"] = OrderedJson::array();
  json["methods"].push_back({{"name", "certified"}, {"force_law", "exponential"}});
  result.choices.push_back(
      {"/methods", "certified", "whose contacts are exact; others may not find the one it rests on"});
  json["loop"] = {{"kind", "closed"}, {"hand", CONTACT_HAND}};
  result.choices.push_back({"/loop/hand", CONTACT_HAND, "a published hand; null for the device alone"});
  result.choices.push_back({"/device", open.device, "its own mass, damping, friction and encoders"});
  const Path path{{0.0, rest.pose}, {CONTACT_SECONDS, rest.pose}};
  result.path_text = tum_text(path, fmt::format("{}, {:.3g} m apart, found by lmdbench init --contact",
                                                json["title"].get<std::string>(), rest.gap));
}

}  // namespace

NewExperiment new_experiment(const std::string& moving, const std::string& fixed,
                             const std::filesystem::path& given_folder,
                             const std::filesystem::path& mesh_folder, const Progress& progress,
                             const InitChoices& chosen) {
  NewExperiment result;
  // Names of meshes lead back through "..", which links would turn elsewhere.
  std::error_code refused;  // shows where the folder is made
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(given_folder, refused);
  const std::filesystem::path folder =
      refused || canonical == std::filesystem::absolute(given_folder / "").lexically_normal().parent_path()
          ? given_folder
          : canonical;
  for (const std::string& mesh : {moving, fixed})
    if (!is_utf8(mesh))
      throw UsageError(printable(mesh), "", "is no UTF-8 name, which an experiment cannot hold",
                       "rename the file");
  result.name = plain_name(stem_of(moving) + "-" + stem_of(fixed), "-_");
  if (result.name.empty()) result.name = "experiment";
  if (chosen.contact) result.name += "-contact";
  result.experiment_file = folder / (result.name + ".json");
  result.specification_file = folder / (result.name + ".path.json");
  result.path_file = folder / (result.name + ".tum");

  OrderedJson json{{"name", result.name},
                   {"title", fmt::format("{} past {}", stem_of(moving), stem_of(fixed))}};
  std::error_code none;
  if ((is_mesh_name(moving) || is_mesh_name(fixed)) &&
      !std::filesystem::equivalent(default_mesh_folder(shortened(folder / ".." / "meshes")), mesh_folder,
                                   none))
    json["mesh_folder"] = path_from(folder, mesh_folder);
  GivenMesh moving_part = part_of(moving, "/moving", mesh_folder);
  GivenMesh fixed_part = part_of(fixed, "/fixed/0", mesh_folder);
  choose_units(moving_part, fixed_part, chosen.unit, result.warnings);
  const bool keep_place = choose_places(moving_part, fixed_part, chosen, result.choices);
  json["moving"] = mesh_entry(moving_part, keep_place, chosen, folder, result.choices);
  json["fixed"] = OrderedJson::array({mesh_entry(fixed_part, keep_place, chosen, folder, result.choices)});
  for (const GivenMesh* part : {&moving_part, &fixed_part})
    if (part == &moving_part || fixed != moving) tell_flaws(*part, result.warnings);

  // The program's choices for a file of two meshes, made in the one place for them.
  const Experiment open = parse_experiment(json.dump(), result.experiment_file);
  std::optional<PreparedRun> prepared;  // has a grazing path, which rest in contact does not need
  Scene scene;
  std::vector<SceneWarning> sizes;
  if (chosen.contact) {
    LoadedScene loaded = load_scene(open);
    scene = std::move(loaded.scene);
    sizes = size_warnings(open, loaded.notes);
    std::copy_if(open.defaults.begin(), open.defaults.end(), std::back_inserter(result.choices),
                 [](const DefaultNote& note) { return note.key != "/methods"; });
    scene.cutoff = default_cutoff(scene, result.choices);
  } else {
    prepared = prepare(open, progress);
    scene = prepared->scene();
    sizes = size_warnings(open, prepared->meshes);
    result.choices.insert(result.choices.end(), prepared->defaults.begin(), prepared->defaults.end());
  }

  for (const SceneWarning& warning : sizes) result.warnings.push_back(to_text(warning));
  json["path"] = {{"file", result.path_file.filename().string()}};
  json["force"] = {{"cutoff_m", scene.cutoff},
                   {"maximum_force_n", open.profiles.front().maximum_force_n},
                   {"sharpness", open.profiles.front().sharpness}};
  json["methods"] = OrderedJson::array();
  for (const MethodChoice& method : open.methods)
    json["methods"].push_back(
        {{"name", method.name}, {"force_law", std::string(to_string(method.force_law))}});
  json["driver"] = {{"search_every_frames", open.driver.search_every_frames},
                    {"search_latency_frames", open.driver.search_latency_frames},
                    {"repetitions", open.driver.repetitions}};
  json["device"] = open.device;
  for (const Probe& probe : probes())
    if (probe.parent == "/probes")
      json["probes"][probe.name] = {{"stride_frames", open.probe_stride(probe.name)}};
  if (chosen.contact) write_contact(result, json, scene, open, progress);
  result.experiment_text = json.dump(2) + "\n";

  if (chosen.contact) return result;

  PathSpec spec = prepared->made_path->spec;
  spec.moving = {.mesh = json["moving"]["mesh"], .placement = open.held().placement};
  spec.fixed = {.mesh = json["fixed"][0]["mesh"], .placement = open.objects.at(1).placement};
  result.specification_text = path_spec_text(spec);
  result.path_text =
      tum_text(prepared->made_path->path,
               fmt::format("{} past {}, {} {}'", stem_of(moving), stem_of(fixed), GENERATED_PATH_MARK,
                           result.specification_file.filename().string()));
  return result;
}

void write_new_experiment(const NewExperiment& experiment) {
  for (const auto& file : {experiment.experiment_file, experiment.specification_file, experiment.path_file})
    if (std::filesystem::exists(std::filesystem::symlink_status(file)) &&  // a link to nothing, too
        !(file == experiment.specification_file && experiment.specification_text.empty()))
      throw UsageError(file.string(), "", "is there already, and may have been edited",
                       "remove it, or name another folder with --out");
  const std::filesystem::path folder = experiment.experiment_file.parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error)
    throw EnvironmentError(folder.string(), "", "cannot be made: " + error.message(),
                           "name another folder with --out");
  if (!experiment.specification_text.empty())
    write_file_atomically(experiment.specification_file, experiment.specification_text);
  write_file_atomically(experiment.path_file, experiment.path_text);
  write_file_atomically(experiment.experiment_file, experiment.experiment_text);
}

}  // namespace lmdbench
