// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/mesh/placement.h>

#include <support/bodies.h>

namespace lmdbench::experiments {

std::shared_ptr<const Body> load_body(const std::string& mesh, const std::filesystem::path& meshes,
                                      double diagonal) {
  TriangleMesh placed = scaled_to_diagonal(resolve_mesh(mesh, meshes).mesh, diagonal);
  return std::make_shared<const Body>(mesh, build_surface(std::move(placed)));
}

Scene load_scene(const SceneChoice& choice) {
  Scene scene;
  scene.moving = load_body(choice.moving, choice.meshes, choice.diagonal);
  scene.fixed = {choice.fixed == choice.moving ? scene.moving
                                               : load_body(choice.fixed, choice.meshes, choice.diagonal)};
  return scene;
}

}  // namespace lmdbench::experiments
