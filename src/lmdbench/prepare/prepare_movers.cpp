// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/prepare/load_body.h>
#include <lmdbench/prepare/prepare_movers.h>
#include <lmdbench/prepare/there_and_back.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/mover_method.h>

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace lmdbench {
namespace {

/// Movers times frames: what is kept of them in memory and in the result.
constexpr std::size_t MOST_MOVER_POSES = 10000000;

/// The mesh of an entry; one that is the moving mesh's or an earlier entry's is read and prepared once.
std::shared_ptr<const Body> body_of(const Experiment& experiment, std::size_t entry, const Scene& scene,
                                    const LoadedMovers& loaded, std::vector<MeshNote>& notes) {
  const MoverChoice& choice = experiment.movers[entry];
  const std::string role = fmt::format("mover_{}", entry);
  const std::size_t first_note = notes.size() - entry;
  if (allowed(experiment.rules, Rule::SHARED_MESH)) {
    const auto share = [&](const std::shared_ptr<const Body>& body, const MeshNote& note) {
      MeshNote copy = note;
      copy.role = role;
      copy.instances.clear();
      copy.first_fixed_body = 0;
      notes.push_back(std::move(copy));
      return body;
    };
    if (same_mesh(experiment.moving, choice.mesh)) return share(scene.moving, notes.front());
    for (const LoadedMovers::Mover& earlier : loaded.movers)
      if (&earlier != &loaded.movers.front() && same_mesh(experiment.movers[earlier.entry].mesh, choice.mesh))
        return share(earlier.body, notes[first_note + earlier.entry]);
  }
  try {
    return load_body(choice.mesh, role, experiment, std::nullopt, notes);
  } catch (const Error& error) {
    throw Error(error.code(), experiment.file.string(), choice.place + "/mesh",
                fmt::format("cannot be used: {}", error.what()), "name another mesh");
  }
}

std::string name_of(const MeshNote& note) {
  return fmt::format("{} {:a} {} {}", note.sha256, note.report.diagonal, note.name,
                     note.vertices ? to_text(note.vertices->deformation()) : "");
}

/// Poses in the frame of the place, one a frame.
std::vector<Pose> read_path(const MoverChoice& choice, const std::string& file, std::size_t frames,
                            double rate, std::vector<InputFile>& files, std::vector<std::string>& warnings) {
  const FileContent content = read_input_file(choice.path_file, {.what = "path"});
  const PathInterpolator path(parse_tum(content.bytes, choice.path_file.string()), choice.interpolation,
                              choice.gap_intervals);
  files.push_back({"path:" + choice.place.substr(1), choice.path_file, content.sha256,
                   static_cast<std::int64_t>(content.bytes.size())});
  if (!path.gaps().empty())
    warnings.push_back(
        fmt::format("{}: its path has {} gaps, in which the mesh is held", choice.place, path.gaps().size()));
  const Path poses = resample(path, rate, frames);
  if (poses.size() < frames)
    throw InputError(file, choice.place + "/path/file",
                     fmt::format("ends after {} frames of the {} that the run has", poses.size(), frames),
                     fmt::format("take a longer path, or run fewer frames (--set /frames={})", poses.size()));
  std::vector<Pose> result;
  for (const TimedPose& timed : poses) result.push_back(timed.pose);
  return result;
}

}  // namespace

LoadedMovers load_movers(const Experiment& experiment, const Scene& scene, std::vector<MeshNote>& notes) {
  LoadedMovers loaded;
  if (experiment.movers.empty()) return loaded;
  loaded.movers.push_back({scene.moving, name_of(notes.front()), 0, 0, Pose{}});
  for (std::size_t i = 0; i < experiment.movers.size(); ++i) {
    const MoverChoice& choice = experiment.movers[i];
    const std::shared_ptr<const Body> body = body_of(experiment, i, scene, loaded, notes);
    MeshNote& note = notes.back();
    note.first_mover = static_cast<std::int64_t>(loaded.movers.size());
    std::vector<Pose> places{choice.mesh.pose};
    if (choice.mesh.instances) {
      places.clear();
      for (const Pose& pose : instance_poses(*choice.mesh.instances, body->prepared<MeshBounds>()))
        places.push_back(choice.mesh.pose * pose);
    }
    note.movers = static_cast<std::int64_t>(places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
      loaded.movers.push_back({body, name_of(note), i, k, places[k]});
  }
  Scene all = scene;
  all.movers.assign(loaded.movers.size(), scene.moving);
  if (!pairs_have_numbers(all))
    throw UsageError(experiment.file.string(), "/movers",
                     fmt::format("{} movers among {} objects that stand: more pairs than can be told apart",
                                 loaded.movers.size(), scene.fixed.size()),
                     "ask for fewer");
  return loaded;
}

Scene with_movers(Scene scene, const LoadedMovers& loaded) {
  for (const LoadedMovers::Mover& mover : loaded.movers)
    if (mover.body != scene.moving) scene.fixed.emplace_back(mover.body);
  return scene;
}

std::shared_ptr<const MoverPlay> play_of(const Experiment& experiment, const LoadedMovers& loaded,
                                         const std::vector<Pose>& moving, std::size_t path_frames,
                                         std::vector<InputFile>& files, std::vector<std::string>& warnings) {
  if (loaded.movers.empty()) return nullptr;
  if (loaded.movers.size() > MOST_MOVER_POSES / moving.size())
    throw UsageError(experiment.file.string(), "/movers",
                     fmt::format("{} movers in {} frames: more than {} poses", loaded.movers.size(),
                                 moving.size(), MOST_MOVER_POSES),
                     "ask for fewer movers or frames");
  std::vector<std::shared_ptr<const Body>> bodies;
  std::vector<std::string> names;
  std::vector<std::vector<Pose>> poses;
  std::vector<Pose> read;  // of the entry under way
  for (const LoadedMovers::Mover& mover : loaded.movers) {
    bodies.push_back(mover.body);
    names.push_back(mover.name);
    std::vector<Pose>& own = poses.emplace_back();
    if (poses.size() == 1) {
      own = moving;
      continue;
    }
    const MoverChoice& choice = experiment.movers[mover.entry];
    if (!choice.path_file.empty()) {
      if (mover.which == 0)
        read = read_path(choice, experiment.file.string(), path_frames, experiment.frame_rate_hz, files,
                         warnings);
      there_and_back(read, moving.size());
      own = read;
    } else {
      const TriangleMesh& mesh = mover.body->surface().mesh;
      const SwayMotion motion(choice.sway, mover.which, bounding_box_centre(mesh),
                              bounding_box_diagonal(mesh));
      for (std::size_t frame = 0; frame < moving.size(); ++frame)
        own.push_back(motion.at(static_cast<double>(frame) / experiment.frame_rate_hz));
    }
    // A product with the identity would round.
    if (!same_pose(mover.place, Pose{}))
      for (Pose& pose : own) pose = mover.place * pose;
  }
  return std::make_shared<const MoverPlay>(make_play(bodies, names, poses));
}

}  // namespace lmdbench
