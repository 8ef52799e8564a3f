// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/import.h>
#include <lmdbench/mesh/shapes.h>

#include <micro/bodies.h>

namespace lmdbench::micro {
namespace {

/// A file where there is one of that name, else what `lmdbench mesh build` leaves.
TriangleMesh load_mesh(const std::string& mesh, const std::filesystem::path& meshes) {
  if (std::filesystem::is_regular_file(mesh)) return import_mesh(mesh);
  return import_mesh(meshes / (mesh + ".off"));
}

}  // namespace

std::shared_ptr<const Body> load_body(const std::string& mesh, const std::filesystem::path& meshes,
                                      double diagonal) {
  TriangleMesh loaded = load_mesh(mesh, meshes);
  const Vec3 centre = bounding_box_centre(loaded);
  loaded = translated(std::move(loaded), -centre);
  const double factor = diagonal / bounding_box_diagonal(loaded);
  loaded = scaled(std::move(loaded), factor);
  return std::make_shared<const Body>(mesh, build_surface(std::move(loaded)));
}

Scene load_scene(const SceneChoice& choice) {
  Scene scene;
  scene.moving = load_body(choice.moving, choice.meshes, choice.diagonal);
  scene.fixed = {choice.fixed == choice.moving ? scene.moving
                                               : load_body(choice.fixed, choice.meshes, choice.diagonal)};
  return scene;
}

}  // namespace lmdbench::micro
