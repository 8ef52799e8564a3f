// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result/sized_datasets.h>
#include <lmdbench/scene/broad_phase.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <numeric>
#include <string_view>
#include <system_error>
#include <utility>

namespace lmdbench {
namespace {

namespace fs = std::filesystem;

/// How the inputs of a result name the file of a mesh: "mesh:bunny-16k".
constexpr std::string_view MESH_ROLE = "mesh:";

/// Where to look for files that a result names, in this order.
struct Places {
  fs::path beside;              ///< Folder of the result file.
  std::vector<fs::path> bases;  ///< Bases of names: working folder, `beside`, run's.
};

Places places_of(const ResultReader& result) {
  const fs::path beside = fs::weakly_canonical(result.file()).parent_path();
  std::error_code none;  // An impossible name finds nothing.
  Places places{beside, {fs::current_path(none)}};
  // Older results have no run folder.
  const std::string run_folder = result.text_attribute("/provenance", "run_folder").value_or("");
  for (const fs::path& base : {beside, fs::weakly_canonical(beside / run_folder, none)})
    if (std::ranges::find(places.bases, base) == places.bases.end()) places.bases.push_back(base);
  return places;
}

/// @param name   of the file as in the run
/// @param sha256 of its bytes then
fs::path find_recorded_file(const fs::path& name, const std::string& sha256, const Places& places) {
  std::vector<fs::path> candidates;
  for (const fs::path& base : places.bases) {
    candidates.push_back(base / name);
    if (base == places.beside) candidates.push_back(base / name.filename());
  }
  std::string changed, looked_in;
  for (const fs::path& candidate : candidates) {
    std::error_code none;
    if (!fs::is_regular_file(candidate, none)) continue;
    if (sha256_of_file(candidate) == sha256) return candidate;
    if (changed.empty()) changed = candidate.string();
  }
  if (!changed.empty())
    throw InputError(changed, "", "has changed since the run: the result was made from other bytes",
                     "give the mesh back its content, or run the experiment again");
  for (const fs::path& base : places.bases) looked_in += (looked_in.empty() ? "" : ", ") + base.string();
  throw InputError(name.string(), "", "the run's mesh is not there, seen from " + looked_in,
                   "put it beside the result file, or run the experiment again");
}

/// Files of the meshes that the run read, with the same bytes; by names of the meshes.
std::map<std::string, std::string> recorded_meshes(const ResultReader& result, const Places& places) {
  const std::vector<std::string> roles = result.texts("/provenance/inputs/role");
  const std::vector<std::string> files = texts_of_size(result, "/provenance/inputs/file", roles.size());
  const std::vector<std::string> hashes = texts_of_size(result, "/provenance/inputs/sha256", roles.size());
  std::map<std::string, std::string> meshes;
  for (std::size_t i = 0; i < roles.size(); ++i)
    if (roles[i].starts_with(MESH_ROLE))
      meshes[roles[i].substr(MESH_ROLE.size())] =
          fs::absolute(find_recorded_file(files[i], hashes[i], places)).string();
  return meshes;
}

/// Replaces the experiment's meshes by the files found.
void use_files(Experiment& experiment, const std::map<std::string, std::string>& meshes) {
  for (ObjectChoice& object : experiment.objects)
    if (const auto found = meshes.find(object.mesh); found != meshes.end()) object.mesh = found->second;
}

/// @param row of arrays of positions and of quaternions x, y, z, w
Pose recorded_pose(const std::vector<double>& p, const std::vector<double>& q, std::size_t row) {
  return {Vec3(p[3 * row], p[3 * row + 1], p[3 * row + 2]),
          Eigen::Quaterniond(q[4 * row + 3], q[4 * row], q[4 * row + 1], q[4 * row + 2])};
}

std::size_t frames_of_result(const ResultReader& result) {
  const std::size_t frames = result.reals("/path/time").size();
  if (frames == 0)
    throw InputError(result.file().string(), "/path/time", "holds no frame", "run the experiment again");
  return frames;
}

ResultTrack track_of(const ResultReader& result, const std::string& method, std::size_t most_frames) {
  const std::string group = method.empty() ? "/path" : "/methods/" + method + "/path";
  const std::vector<double> times = result.reals("/path/time");
  const std::vector<double> p = reals_of_size(result, group + "/position", 3 * times.size());
  const std::vector<double> q = reals_of_size(result, group + "/orientation", 4 * times.size());
  const std::size_t stride = std::max<std::size_t>(1, (times.size() + most_frames - 1) / most_frames);
  ResultTrack track{method, {}, {}};
  for (std::size_t f = 0; f < times.size(); f += stride) {
    track.frames.push_back(f);
    track.poses.push_back({times[f], recorded_pose(p, q, f)});
  }
  return track;
}

const MethodDescription& exact_description() {
  for (const MethodDescription& description : method_descriptions())
    if (description.promise == Promise::COMPLETE_SET && !description.brute_force) return description;
  throw EnvironmentError("", "", "this build has no method that is complete in every frame",
                         "build all methods");
}

/// @param base folder of the experiment's file if its name is relative
Experiment experiment_of_result(const ResultReader& result, const fs::path& base) {
  // For the scene alone; plugins need not be here, since no file may decide what is loaded.
  nlohmann::json text =
      nlohmann::json::parse(texts_of_size(result, "/provenance/experiment", 1).front(), nullptr, false);
  const std::vector<std::string> known = method_names();
  if (text.is_object() && text.contains("methods") && text["methods"].is_array())
    for (nlohmann::json& method : text["methods"])
      if (method.is_object() && std::ranges::find(known, method.value("name", "")) == known.end())
        method = {{"name", exact_description().name}, {"label", method.value("label", "")}};
  return parse_experiment(text.dump(),
                          base / result.text_attribute("/provenance", "experiment_file").value_or(""));
}

/// Vertex files and lists of poses must be those of the run.
void check_files(const Experiment& experiment, const std::vector<MeshNote>& notes,
                 const ResultReader& result) {
  const std::vector<std::string> roles = result.texts("/provenance/inputs/role");
  const std::vector<std::string> hashes = texts_of_size(result, "/provenance/inputs/sha256", roles.size());
  const auto check = [&](const std::string& role, const std::string& hash, const fs::path& file,
                         const std::string& changed) {
    const auto found = std::ranges::find(roles, role);
    if (found == roles.end() || hashes[static_cast<std::size_t>(found - roles.begin())] != hash)
      throw InputError(file.string(), "", changed + " since the run",
                       "give back the old content, or run the experiment again");
  };
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const MeshNote& note = notes[i];
    if (note.vertices && !note.vertices->sha256().empty())
      check("vertices:" + note.role, note.vertices->sha256(),
            vertex_files(note.vertices->deformation()).front(), "this or another vertex file has changed");
    if (const auto& instances = experiment.objects[i].instances; instances && !instances->file.empty())
      check("instances:" + note.role, sha256_of_file(instances->file), instances->file,
            "the list of poses has changed");
  }
}

/// Movers with their recorded poses.
std::shared_ptr<const MoverPlay> recorded_play(const std::vector<Mover>& movers, const ResultReader& result,
                                               std::size_t frames) {
  if (movers.empty()) return nullptr;
  const std::size_t rows = frames * movers.size();
  const std::vector<double> p = reals_of_size(result, "/path/movers/position", 3 * rows);
  const std::vector<double> q = reals_of_size(result, "/path/movers/orientation", 4 * rows);
  std::vector<std::vector<Pose>> poses(movers.size());
  for (std::size_t i = 0; i < rows; ++i) poses[i % movers.size()].push_back(recorded_pose(p, q, i));
  return std::make_shared<const MoverPlay>(make_play(movers, poses));
}

ResultScene scene_of_experiment(const Experiment& experiment, const ResultReader& result,
                                std::size_t frames) {
  const LoadedScene loaded = load_scene(experiment);
  Scene scene = loaded.scene;
  check_files(experiment, loaded.notes, result);
  scene.cutoff = result.real_attribute("/scene", "cutoff_m").value_or(scene.cutoff);
  for (const std::string& label : result.groups("/methods"))
    scene.cutoff =
        std::max(scene.cutoff, result.real_attribute("/methods/" + label, "cutoff_m").value_or(0.0));
  const SceneMotion motion{recorded_play(loaded.movers, result, frames),
                           deformation_of(loaded.notes, static_cast<std::int64_t>(frames))};
  return {motion.movers ? motion.movers->with_movers(scene) : scene, motion, frames};
}

}  // namespace

ResultScene scene_of_result(const ResultReader& result) {
  const std::size_t frames = frames_of_result(result);
  const Places places = places_of(result);
  const std::map<std::string, std::string> meshes = recorded_meshes(result, places);
  // The experiment's other names (manifest, vertex files, instances) are relative to its own file.
  for (auto base = places.bases.begin();; ++base) {
    try {
      Experiment experiment = experiment_of_result(result, *base);
      use_files(experiment, meshes);
      return scene_of_experiment(experiment, result, frames);
    } catch (const InputError&) {
      if (std::next(base) == places.bases.end()) throw;
    }
  }
}

std::vector<ResultTrack> tracks_of_result(const ResultReader& result, std::size_t most_frames) {
  std::vector<std::string> devices;
  for (const std::string& label : result.groups("/methods"))
    if (result.has("/methods/" + label + "/path/position")) devices.push_back(label);
  if (devices.empty()) return {track_of(result, "", most_frames)};
  std::vector<ResultTrack> tracks;
  for (const std::string& label : devices)
    tracks.push_back(track_of(result, label, std::max<std::size_t>(1, most_frames / devices.size())));
  return tracks;
}

std::vector<std::size_t> drawn_bodies(const Scene& scene, const std::vector<ResultTrack>& tracks) {
  std::vector<std::size_t> drawn(scene.fixed.size());
  std::iota(drawn.begin(), drawn.end(), std::size_t{0});
  if (!scene.is_world() || drawn.size() <= MOST_DRAWN) return drawn;
  const BroadPhase phase(scene);
  std::map<std::size_t, double> nearest;
  for (const ResultTrack& track : tracks)
    for (const TimedPose& timed : track.poses) {
      std::size_t visited = 0;
      phase.by_distance(timed.pose, [&](std::uint32_t instance, double bound) {
        double& least = nearest.try_emplace(instance, bound).first->second;
        least = std::min(least, bound);
        return ++visited < MOST_DRAWN;
      });
    }
  std::vector<std::pair<double, std::size_t>> order;
  for (const auto& [instance, bound] : nearest) order.emplace_back(bound, instance);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), MOST_DRAWN));
  drawn.clear();
  for (const auto& [bound, instance] : order) drawn.push_back(instance);
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

std::unique_ptr<Method> exact_method(const Scene& scene) {
  return make_method(exact_description().name, scene);
}

}  // namespace lmdbench
