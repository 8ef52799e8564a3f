// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/lmd/scene.h>

#include <filesystem>
#include <memory>
#include <string>

namespace lmdbench::experiments {

/// A mesh of the manifest or a mesh file (see `resolve_mesh`), with its bounding box centred on the
/// origin and scaled to the given diagonal [m].
std::shared_ptr<const Body> load_body(const std::string& mesh, const std::filesystem::path& meshes,
                                      double diagonal);

/// Options of all programs here for a scene of two bodies. Lengths are shares of the moving body's
/// diagonal, except for the diagonal itself.
struct SceneChoice {
  std::string moving = "bunny-16k";
  std::string fixed = "bunny-16k";
  std::filesystem::path meshes = "meshes";
  double diagonal = 0.15;  ///< metres, of both bodies
  double gap = 0.002;
};

/// The scene without a cutoff (0); equal meshes share one body.
Scene load_scene(const SceneChoice& choice);

}  // namespace lmdbench::experiments
