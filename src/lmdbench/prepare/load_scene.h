// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/prepare/mover_play.h>
#include <lmdbench/prepare/scene_deformation.h>
#include <lmdbench/shape/flatten.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// The mesh of an object with what is worth knowing of it when one reads the result.
struct MeshNote {
  std::string role;                           ///< Of the object, ...
  std::string object;                         ///< ... its name, ...
  MotionKind motion = MotionKind::STANDS;     ///< ... and how it moves.
  std::string name;                           ///< Of the mesh.
  std::optional<std::filesystem::path> file;  ///< What was read; nothing for a generated shape.
  std::int64_t size = 0;                      ///< Bytes of that file
  std::string sha256;  ///< Of that file, or of the file that a generated shape would be built to.
  ValidityReport report;
  FlatteningReport flattening;  ///< In metres of the scene.
  OrientationReport orientation;
  std::shared_ptr<const FrameVertices> vertices;  ///< Of a mesh that deforms, frame by frame.
  std::shared_ptr<const Body> body;               ///< At rest.
  std::vector<Pose> instances;        ///< X_WF of each; empty for a mesh that is in the world frame.
  std::int64_t first_fixed_body = 0;  ///< `Lmd::fixed_body` of the first of an object that stands.
  std::int64_t first_mover = 0;       ///< Number of the first mover of an object that moves, and ...
  std::int64_t movers = 0;            ///< ... how many it has; 0 of the held one and of what stands.
};

/// The objects of an experiment, loaded. Meshes that are the same are read and prepared once.
struct LoadedScene {
  Scene
      scene;  ///< The held object and what stands; MoverPlay adds what moves. The cutoff is left to the caller.
  std::vector<MeshNote> notes;  ///< One an object.
  std::vector<Mover>
      movers;  ///< In the order of the file, the held one first; none where nothing else moves.

  /// What stands and what moves as one scene, for what looks at sizes alone.
  Scene all_meshes() const;
};

/// @throws InputError naming the object for a mesh that cannot be used
/// @throws UsageError where so many move that pairs have no number
LoadedScene load_scene(const Experiment& experiment);

/// How the bodies of a loaded scene deform in so many frames; null where none does.
std::shared_ptr<const SceneDeformation> deformation_of(const std::vector<MeshNote>& notes,
                                                       std::int64_t frames);

/// A fixed mesh with its vertices in the world frame.
TriangleMesh placed_mesh(const FixedBody& fixed);

}  // namespace lmdbench
