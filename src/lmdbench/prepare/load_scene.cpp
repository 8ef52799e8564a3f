// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace lmdbench {
namespace {

/// @param X_WF moves its vertices into the world; unset: they stay in the mesh's own frame
/// @param place  of what is read, for the caller's messages
MeshNote load_mesh(const ObjectChoice& object, const Experiment& experiment, const std::optional<Pose>& X_WF,
                   std::string& place) {
  place = object.place + "/mesh";
  const ResolvedMesh resolved =
      is_mesh_name(object.mesh)
          ? resolve_mesh(object.mesh, experiment.mesh_folder)
          : resolve_mesh(shortened(experiment.file.parent_path() / object.mesh).string());
  MeshNote note;
  note.name = object.mesh;
  note.file = resolved.file;
  note.size = resolved.size;
  note.sha256 = resolved.sha256;
  TriangleMesh mesh = resolved.mesh;  // `resolved` is compared with vertex files
  // In the file's coordinates, which show their rounding; scaling hides it.
  const double scale = object.placement.factor(mesh);
  PlanarTolerance tolerance = object.planar_tolerance;
  if (tolerance.kind == PlanarTolerance::Kind::LENGTH) tolerance.value /= scale;
  if (object.orientation == OrientationChoice::OUTWARD) note.orientation = orient_outward(mesh);
  note.flattening = flatten(mesh, tolerance, !object.deformation);
  note.flattening.tolerance *= scale;
  note.flattening.largest_move *= scale;
  mesh = placed(std::move(mesh), object.placement);
  if (object.deformation) {
    place = object.deformation->place;
    if (!object.deformation->generator) place += object.deformation->files.empty() ? "/folder" : "/files";
    note.vertices = std::make_shared<const FrameVertices>(
        *object.deformation, DeformingMesh{resolved.mesh, object.placement, mesh, X_WF},
        experiment.frame_rate_hz);
    place = object.place + "/mesh";
  }
  const double diagonal = bounding_box_diagonal(mesh);
  if (X_WF)
    for (Vec3& vertex : mesh.vertices) vertex = RigidTransform(*X_WF).point(vertex);
  refuse_extreme_size(mesh, object.mesh);
  note.body = std::make_shared<const Body>(object.mesh, build_surface(std::move(mesh)), diagonal);
  note.report = check_mesh(note.body->surface());
  note.report.diagonal = diagonal;
  return note;
}

/// @param earlier notes of the objects before it
MeshNote load_object(const Experiment& experiment, std::size_t index, const std::vector<MeshNote>& earlier) {
  const ObjectChoice& object = experiment.objects[index];
  const auto shared =
      allowed(experiment.rules, Rule::SHARED_MESH) ? shared_body(experiment, index) : std::nullopt;
  MeshNote note;
  if (shared) {
    note = earlier[*shared];
    note.instances.clear();
    note.first_mover = note.movers = 0;
  } else {
    std::string place;
    const bool in_world = object.stands() && !stands_in_own_frame(experiment, index);
    try {
      note = load_mesh(object, experiment, in_world ? std::optional(object.pose) : std::nullopt, place);
    } catch (const InputError& error) {
      throw InputError(experiment.file.string(), place, fmt::format("cannot be used: {}", error.what()), "");
    }
  }
  note.role = object.role;
  note.object = object.name;
  note.motion = object.motion.kind;
  return note;
}

/// Poses of an object, or the places it moves about.
std::vector<Pose> places_of(const ObjectChoice& object, const Body& body) {
  if (!object.instances) return {object.pose};
  std::vector<Pose> places;
  for (const Pose& pose : instance_poses(*object.instances, body.prepared<MeshBounds>()))
    places.push_back(object.pose * pose);
  return places;
}

Mover mover_of(const MeshNote& note, std::size_t object, std::size_t which, const Pose& place) {
  return {note.body,
          fmt::format("{} {:a} {} {}", note.sha256, note.report.diagonal, note.name,
                      note.vertices ? to_text(note.vertices->deformation()) : ""),
          object, which, place};
}

}  // namespace

Scene LoadedScene::all_meshes() const {
  Scene all = scene;
  for (const Mover& mover : movers)
    if (mover.body != scene.moving) all.fixed.emplace_back(mover.body);
  return all;
}

LoadedScene load_scene(const Experiment& experiment) {
  LoadedScene loaded;
  auto& [scene, notes, movers] = loaded;
  const bool several_move = experiment.several_move();
  for (std::size_t i = 0; i < experiment.objects.size(); ++i) {
    const ObjectChoice& object = experiment.objects[i];
    MeshNote& note = notes.emplace_back(load_object(experiment, i, notes));
    const std::vector<Pose> places = places_of(object, *note.body);
    if (i == 0) {
      scene.moving = note.body;
      if (several_move) movers.push_back(mover_of(note, i, 0, Pose{}));
    } else if (object.stands()) {
      note.first_fixed_body = static_cast<std::int64_t>(scene.fixed.size());
      if (object.instances) note.instances = places;
      const bool in_own_frame = stands_in_own_frame(experiment, i);
      for (const Pose& place : places) scene.fixed.emplace_back(note.body, in_own_frame ? place : Pose{});
    } else {
      note.first_mover = static_cast<std::int64_t>(movers.size());
      note.movers = static_cast<std::int64_t>(places.size());
      for (std::size_t k = 0; k < places.size(); ++k) movers.push_back(mover_of(note, i, k, places[k]));
    }
  }
  Scene all = scene;
  all.movers.assign(movers.size(), scene.moving);
  if (!ObjectPair::have_numbers(all))
    throw UsageError(experiment.file.string(), experiment.objects[movers.back().object].place,
                     fmt::format("{} movers among {} objects that stand: more pairs than can be told apart",
                                 movers.size(), scene.fixed.size()),
                     "ask for fewer");
  return loaded;
}

std::shared_ptr<const SceneDeformation> deformation_of(const std::vector<MeshNote>& notes,
                                                       std::int64_t frames) {
  std::vector<DeformingBody> bodies;
  for (const MeshNote& note : notes)
    if (note.vertices) bodies.push_back({note.body, note.vertices});
  if (bodies.empty()) return nullptr;
  return std::make_shared<const SceneDeformation>(std::move(bodies), frames);
}

TriangleMesh placed_mesh(const FixedBody& fixed) {
  TriangleMesh mesh = fixed->surface().mesh;
  if (!fixed.is_placed()) return mesh;
  const RigidTransform X_WF(fixed.X_WF);
  for (Vec3& vertex : mesh.vertices) vertex = X_WF.point(vertex);
  return mesh;
}

}  // namespace lmdbench
