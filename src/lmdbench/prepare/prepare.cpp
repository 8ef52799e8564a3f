// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/phantom/device.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/prepare/scene_path.h>
#include <lmdbench/prepare/scene_warnings.h>
#include <lmdbench/snch/hierarchy.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <utility>

namespace lmdbench {
namespace {

ForceProfile profile_for(const ForceChoice& force, double cutoff, const std::string& place,
                         const Experiment& experiment) {
  ForceProfile profile;
  profile.cutoff = cutoff;
  profile.saturation_distance = force.saturation(cutoff);
  profile.maximum_force = force.maximum_force_n;
  profile.sharpness = force.sharpness;
  if (force.clip_at_maximum) profile.largest_sum = force.maximum_force_n;
  // Loading could compare only two lengths; here a share of the mesh's diagonal is one, too.
  if (!(profile.saturation_distance < profile.cutoff))
    throw UsageError(experiment.file.string(), place + "/saturation_m",
                     fmt::format("saturation at {} m is not below the cutoff of {} m",
                                 profile.saturation_distance, profile.cutoff),
                     "saturate nearer than the cutoff");
  return profile;
}

/// Preparations for every run, in parallel for meshes large enough for threads.
void prepare_hierarchies(const Scene& scene) {
  constexpr std::size_t WORTH_A_THREAD = 2048;  // triangles
  const auto large = [](const FixedBody& body) {
    return body->surface().mesh.triangles.size() >= WORTH_A_THREAD;
  };
  if (!large(scene.moving) || std::none_of(scene.fixed.begin(), scene.fixed.end(), large)) return;
  parallel_for(scene.fixed.size() + 1,
               [&](std::size_t i) { (i == 0 ? scene.moving : scene.fixed[i - 1])->prepared<Hierarchy>(); });
}

/// The experiment's profiles, with the cutoff chosen where they give none.
struct Profiles {
  std::vector<PreparedProfile> profiles;
  std::vector<DefaultNote> defaults;
};

Profiles profiles_of(const Experiment& experiment, const LoadedScene& loaded) {
  Profiles result;
  std::optional<double> open_cutoff;  // of profiles without one
  for (std::size_t i = 0; i < experiment.profiles.size(); ++i) {
    const ForceChoice& choice = experiment.profiles[i];
    const std::string place = choice.name.empty() ? "/force" : fmt::format("/force/{}", i);
    std::optional<double> cutoff = choice.cutoff(loaded.notes.front().report.diagonal);
    if (!cutoff) {
      if (!open_cutoff) open_cutoff = default_cutoff(loaded.all_meshes(), result.defaults);
      cutoff = open_cutoff;
    }
    result.profiles.push_back(
        {choice.name, profile_for(choice, *cutoff, place, experiment), loaded.scene, choice.aggregation});
    result.profiles.back().scene.cutoff = result.profiles.back().force.cutoff;
  }
  return result;
}

/// Files of the experiment's methods from outside.
std::set<std::filesystem::path> plugin_files(const Experiment& experiment) {
  std::set<std::filesystem::path> files;
  for (const MethodChoice& choice : experiment.methods) files.insert(method_description(choice.name).plugin);
  files.erase(std::filesystem::path());
  return files;
}

InputFile input_file(const std::string& role, const std::filesystem::path& file) {
  return {role, file, sha256_of_file(file), static_cast<std::int64_t>(std::filesystem::file_size(file))};
}

/// For the provenance: one entry a file.
std::vector<InputFile> mesh_files(const std::vector<MeshNote>& notes) {
  std::vector<InputFile> files;
  for (const MeshNote& note : notes) {
    const bool listed = std::ranges::any_of(files, [&](const InputFile& file) {
      return file.role == "mesh:" + note.name && file.sha256 == note.sha256;
    });
    if (note.file && !listed) files.push_back({"mesh:" + note.name, *note.file, note.sha256, note.size});
    if (note.vertices && !note.vertices->sha256().empty())
      files.push_back({"vertices:" + note.role, vertex_files(note.vertices->deformation()).front(),
                       note.vertices->sha256(), note.vertices->file_bytes()});
  }
  return files;
}

template <typename Value>
void append(std::vector<Value>& all, const std::vector<Value>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

PreparedRun prepare(const Experiment& experiment, const Progress& progress, Deforming deforming) {
  if (deforming == Deforming::REFUSED) {
    refuse_deformation(experiment);
    refuse_movers(experiment);
  }
  const Device& device = device_named(experiment.device, experiment.file.string(), "/device");
  std::optional<FramePath> path;
  if (!experiment.held().motion.path_file.empty()) path = read_held_path(experiment);
  std::vector<InputFile> plugins;
  for (const std::filesystem::path& plugin : plugin_files(experiment))
    plugins.push_back(input_file("plugin:" + plugin.filename().string(), plugin));
  LoadedScene loaded = load_scene(experiment);
  Profiles profiles = profiles_of(experiment, loaded);

  PreparedRun prepared{.profiles = std::move(profiles.profiles),
                       .input = {.frame_rate_hz = experiment.frame_rate_hz,
                                 .loop = experiment.loop,
                                 .device = VirtualPhantom(device)}};
  prepared.defaults = experiment.defaults;
  append(prepared.defaults, profiles.defaults);
  if (path) prepared.files.push_back(path->file);
  append(prepared.files, plugins);
  if (!path) {
    // Near enough for the profile with the least cutoff, and so for all.
    const auto& [name, force, scene, aggregation] = *std::ranges::min_element(
        prepared.profiles, {}, [](const PreparedProfile& profile) { return profile.force.cutoff; });
    path = make_path(experiment, scene, progress);
    prepared.files.push_back(path->file);
    prepared.defaults.push_back(note_of(*path->made, force.cutoff));
  }
  prepared.path_gaps = std::move(path->gaps);
  prepared.made_path = std::move(path->made);

  DriverInput& input = prepared.input;
  for (const TimedPose& frame : path->frames) {
    input.poses.push_back(frame.pose);
    prepared.times.push_back(frame.time);
  }
  if (experiment.realtime && experiment.realtime->seconds)
    lengthen(input.poses, prepared.times, experiment.frame_rate_hz, *experiment.realtime->seconds,
             experiment.file.string());
  if (!loaded.movers.empty()) {
    const MoverPoses poses = mover_poses(experiment, loaded.movers, input.poses, path->frames);
    append(prepared.files, poses.files);
    append(prepared.warnings, poses.warnings);
    input.motion.movers = std::make_shared<const MoverPlay>(make_play(loaded.movers, poses.of_mover));
    for (PreparedProfile& profile : prepared.profiles)
      profile.scene = input.motion.movers->with_movers(profile.scene);
  }
  input.motion.deformation = deformation_of(loaded.notes, static_cast<std::int64_t>(input.poses.size()));
  input.reference_M = bounding_box_centre(prepared.scene().moving->surface().mesh);
  prepared.meshes = std::move(loaded.notes);
  append(prepared.files, mesh_files(prepared.meshes));
  for (std::size_t i = 0; i < experiment.objects.size(); ++i)
    if (const auto& instances = experiment.objects[i].instances; instances && !instances->file.empty())
      prepared.files.push_back(input_file("instances:" + prepared.meshes[i].role, instances->file));
  append(prepared.warnings, deformation_warnings(prepared.meshes, input.motion.deformation.get(),
                                                 prepared.made_path.has_value()));
  append(prepared.warnings, mesh_warnings(experiment, prepared.meshes));
  append(prepared.warnings, aggregation_warnings(experiment, prepared.meshes));
  prepare_hierarchies(prepared.scene());
  prepared.starts_touching =
      SceneDistance(prepared.scene(), input.motion).at(0, input.poses.front(), prepared.scene().cutoff) ==
      0.0;
  if (prepared.starts_touching)
    prepared.warnings.emplace_back(
        "the meshes touch in the first frame: LMDs of triangles that intersect have no direction there and "
        "exert no force until they have been apart");
  return prepared;
}

void hold_first_frame(PreparedRun& prepared) {
  for (PreparedProfile& profile : prepared.profiles) {
    SceneFrames first(profile.scene, prepared.input.motion);
    first.to_frame(0);
    profile.scene = first.scene();
  }
  prepared.input.motion = {};
}

std::vector<std::filesystem::path> input_files(const Experiment& experiment) {
  const std::filesystem::path folder = experiment.file.parent_path();
  std::vector<std::filesystem::path> files{experiment.file, experiment.mesh_folder / "manifest.json"};
  for (const std::filesystem::path& plugin : plugin_files(experiment)) files.push_back(plugin);
  for (const ObjectChoice& object : experiment.objects) {
    if (!object.motion.path_file.empty()) files.push_back(object.motion.path_file);
    if (object.instances && !object.instances->file.empty()) files.push_back(object.instances->file);
    files.push_back(is_mesh_name(object.mesh) ? built_mesh_file(experiment.mesh_folder, object.mesh)
                                              : folder / object.mesh);
    if (!object.deformation) continue;
    std::error_code none;  // Loading reports a missing folder.
    if (!object.deformation->folder.empty() &&
        !std::filesystem::is_directory(object.deformation->folder, none))
      continue;
    for (const std::filesystem::path& file : vertex_files(*object.deformation)) files.push_back(file);
  }
  return files;
}

std::vector<DrivenMethod> driven_methods(const Experiment& experiment, const PreparedRun& prepared) {
  std::vector<DrivenMethod> methods;
  for (const MethodChoice& choice : experiment.methods) {
    const PreparedProfile& profile = prepared.profiles[choice.profile];
    ForceProfile force = profile.force;
    force.law = choice.force_law;
    const auto make_on = [name = choice.name, options = choice.options](const Scene& scene) {
      return make_method(name, scene, options);
    };
    methods.push_back({choice.label, [make_on, scene = profile.scene] { return make_on(scene); }, force,
                       choice.aggregation, profile.scene, make_on});
  }
  return methods;
}

}  // namespace lmdbench
